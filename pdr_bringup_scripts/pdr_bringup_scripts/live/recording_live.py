"""Records running nodes until the user ends it."""

import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from pdr_bringup_scripts.interrupt import Interrupt
from pdr_bringup_scripts.live.chain import stay_on_this_machine
from pdr_bringup_scripts.live.listener import Ears, own_definitions
from pdr_bringup_scripts.live.recorder import Recorder
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.run_folder import new_run_folder
from pdr_bringup_scripts.run.track_book import make_folder
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.words import counted, duration
from pdr_core.recording.mcap_writer import McapWriter

SUFFIX = ".mcap"
FLUSH_S = 0.25  # what a crash may take, beside what is on its way
PATIENCE_S = 5.0  # without a sample, before we say so
REMINDER_S = 30.0


def new_file() -> Path:
    """Return a file that no other recording has."""
    return new_run_folder("record").with_suffix(SUFFIX)


def record_nodes(home: str, path: Path, duration_s: float | None, terminal: Terminal) -> str:
    """Record the nodes of a namespace until Ctrl-C or the duration; return what was recorded in a sentence.

    Problem if no sample came: then there is no file.
    """
    check_new(path)
    stay_on_this_machine(Path(tempfile.gettempdir()) / "pdr_record", None)
    with ExitStack() as stack:
        interrupt = stack.enter_context(Interrupt())
        show = stack.enter_context(terminal.progress("Recording"))
        ears = stack.enter_context(Ears(lambda *_: None, home, {}))
        file = stack.enter_context(McapWriter(path, own_definitions()))
        recorder, begin_s = Recorder(ears.node, home, file, terminal.say), time.monotonic()
        due = (
            Repeated(FLUSH_S, FLUSH_S, lambda: save(file, recorder, show, begin_s)),
            Repeated(PATIENCE_S, REMINDER_S, lambda: complain(home, recorder, terminal)),
        )
        while not (interrupt.asked or (duration_s is not None and time.monotonic() - begin_s > duration_s)):
            ears.listen(0.05)
            recorder.look()
            for work in due:
                work.look()
        silence = "" if recorder.samples else why_silent(home, recorder)
    if silence:
        path.unlink()
        raise Problem(silence)
    passed = duration(time.monotonic() - begin_s)
    return f"Recorded {words(recorder.samples)} in {passed} to {path}. Estimate it: pdr run {path} --as-recorded"


def check_new(path: Path) -> None:
    """Make the folder of a new recording; Problem if the path cannot be one."""
    if path.suffix != SUFFIX:
        raise Problem(f"{path}: choose a name that ends in {SUFFIX}")
    if path.exists():
        raise Problem(f"{path} exists already: choose another name by --out, or remove it")
    make_folder(path.parent)


class Repeated:
    """Work that is done now and then."""

    def __init__(self, first_s: float, then_s: float, work: Callable[[], None]) -> None:
        self._due_s, self._then_s, self._work = time.monotonic() + first_s, then_s, work

    def look(self) -> None:
        """Do it if it is time."""
        if time.monotonic() > self._due_s:
            self._due_s = time.monotonic() + self._then_s
            self._work()


def save(file: McapWriter, recorder: Recorder, show: Callable[[str], None], begin_s: float) -> None:
    """Let the disk have what has come, and show how much that is."""
    file.flush()
    show(f"{time.monotonic() - begin_s:.0f} s, {words(recorder.samples)}, {file.size_bytes / 1e6:.1f} MB")


def complain(home: str, recorder: Recorder, terminal: Terminal) -> None:
    """Say it where no sample comes."""
    if not recorder.samples:
        terminal.say(f"pdr: {why_silent(home, recorder)}")


def words(samples: dict[str, int]) -> str:
    """Say how much has come of which sensor."""
    said = [f"{counted(count, 'sample')} of {topic.strip('/')}" for topic, count in sorted(samples.items())]
    return ", ".join(said) or "no sample yet"


def why_silent(home: str, recorder: Recorder) -> str:
    """Say in a sentence why no sample may have come."""
    start = f"no samples of nodes in namespace /{home}"
    if found := recorder.elsewhere:
        return f"{start}; nodes of pdr are in {', '.join(found)}: choose by --namespace"
    return f"{start} yet: start the nodes and the driver, in the ROS domain of this terminal"
