"""Studies recordings one after the other; one that cannot be read does not stop the others."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Generic, TypeVar

from pdr_bringup_scripts.options import known_name
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_bringup_scripts.terminal import Bar, Terminal
from pdr_core.bench.detectors import DETECTORS, study
from pdr_core.bench.trial import NoSamples, Walk
from pdr_core.evaluation.detector_page import detector_page
from pdr_core.evaluation.detector_study import DetectorStudy
from pdr_core.evaluation.detector_tables import as_csv, as_json
from pdr_core.params import Params
from pdr_core.pipeline.stance_phases import TIME_GATES
from pdr_core.recording import RecordingError, Sensor, Session, open_recording
from pdr_core.warmup import warm_up

FILES = "compare.html, compare.csv, compare.json"


S = TypeVar("S")
Seen = Callable[[str], object]


@dataclass(frozen=True)
class DetectorJob:
    """Which detectors are compared, and whether figures alone are wanted or pictures too."""

    params: Params
    detectors: Sequence[str]
    gates: Sequence[str]
    deep: bool

    def __call__(self, walk: Walk, seen: Seen) -> DetectorStudy:
        """Study one sensor."""
        return study(walk, self.params, self.detectors, self.gates, self.deep, seen)


@dataclass(frozen=True)
class Compared(Generic[S]):
    """What came of it."""

    studies: list[S] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)  # one sentence for each recording that is missing
    warnings: list[str] = field(default_factory=list)  # what could not be read of the others


def chosen_detectors(text: str) -> list[str]:
    """Return the detectors of a list with commas; Problem if one does not exist."""
    return chosen(text, DETECTORS, "--detectors")


def chosen_gates(text: str) -> list[str]:
    """Return the time gates of a list with commas; Problem if one does not exist."""
    return chosen(text, TIME_GATES, "--time-gates")


def chosen(text: str, known: Sequence[str], option: str) -> list[str]:
    """Return the names of a list, each once, or all that are known."""
    names = [known_name(option, name.strip(), ("all", *known)) for name in text.split(",")]
    return list(known) if "all" in names else list(dict.fromkeys(names))


def compared(
    paths: Sequence[Path], columns: Path | None, job: Callable[[Walk, Seen], S], terminal: Terminal
) -> Compared[S]:
    """Study every sensor of every recording."""
    warm_up()
    done: Compared[S] = Compared()
    with terminal.bar("Comparing", len(paths)) as bar:
        for path, name in zip(paths, names(paths), strict=True):
            with noted(path, done.problems):
                session = open_recording(path, column_map=columns)
                for sensor in session.sensors.values():
                    with noted(path, done.problems):
                        done.studies.append(studied(walk_of(session, sensor, name), job, bar))
                done.warnings.extend(f"Warning: {name}: {notice.text.rstrip('.')}." for notice in session.notices)
            bar.advance()
    return done


@contextmanager
def noted(path: Path, problems: list[str]) -> Iterator[None]:
    """Note that something cannot be read, and go on after it."""
    try:
        yield
    except (NoSamples, RecordingError) as problem:
        problems.append(str(problem))
    except OSError as error:
        problems.append(f"{error.filename or path}: {error.strerror or error}")


def names(paths: Sequence[Path]) -> list[str]:
    """Return the shortest name of each path that tells it from the others: its own, or all of it."""
    short = [path.stem for path in paths]
    return [stem if short.count(stem) == 1 else str(path) for stem, path in zip(short, paths, strict=True)]


def walk_of(session: Session, sensor: Sensor, name: str) -> Walk:
    """Read a sensor of a recording, once, whole."""
    own_name = name if len(session.sensors) == 1 else f"{name} {sensor.name}"
    return Walk(own_name, list(sensor.pieces()), sensor.truth)


def studied(walk: Walk, job: Callable[[Walk, Seen], S], bar: Bar) -> S:
    """Study one sensor."""
    return job(walk, lambda what: bar.show(f"{walk.name}: {what}"))


def write_files(out: Path, studies: Sequence[DetectorStudy], terminal: Terminal) -> None:
    """Write the page and the figures into a folder that exists."""
    page = detector_page(studies, VERSION, commit())
    for name, text in zip(FILES.split(", "), (page, as_csv(studies), as_json(studies) + "\n"), strict=True):
        (out / name).write_text(text, encoding="utf-8")
    terminal.say(f"Written to {out}: {FILES}")


def tell(done: Compared[S], terminal: Terminal) -> None:
    """Say what could not be read of some recordings; Problem, after all else, if others could not be read at all."""
    for warning in done.warnings:
        terminal.say(warning)
    if done.problems:
        raise Problem("\n".join(done.problems))
