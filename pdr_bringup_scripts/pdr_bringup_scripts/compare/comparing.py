"""Studies recordings one after the other; one that cannot be read does not stop the others."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

from pdr_bringup_scripts.options import known_name
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.track_book import make_folder
from pdr_bringup_scripts.terminal import Bar, Terminal
from pdr_core.bench.trial import NoSamples, Walk
from pdr_core.recording import RecordingError, Sensor, Session, open_recording
from pdr_core.warmup import warm_up

S = TypeVar("S")
Seen = Callable[[str], object]


class Comparison(Protocol[S]):
    """What is compared: the study of one sensor, and how those of all are shown."""

    def study(self, walk: Walk, seen: Seen) -> S:
        """Study one sensor."""

    def show(self, studies: Sequence[S]) -> None:
        """Print the tables."""

    def as_json(self, studies: Sequence[S]) -> str:
        """Return everything as one JSON object."""

    def files(self, studies: Sequence[S]) -> Mapping[str, str]:
        """Return the text of every file by its name."""


@dataclass(frozen=True)
class Compared(Generic[S]):
    """What came of it."""

    studies: list[S] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)  # one sentence for each recording that is missing
    warnings: list[str] = field(default_factory=list)  # what could not be read of the others


def chosen(text: str, known: Sequence[str], option: str) -> list[str]:
    """Return the names of a list with commas, each once, or all that are known; Problem if one does not exist."""
    names = [known_name(option, name.strip(), ("all", *known)) for name in text.split(",")]
    return list(known) if "all" in names else list(dict.fromkeys(names))


def compare_recordings(
    paths: Sequence[Path], columns: Path | None, comparison: Comparison[Any], out: Path | None, json: bool
) -> None:
    """Study every sensor of every recording; print and write what came of it.

    Problem, after all else, if some could not be read at all.
    """
    if out:
        make_folder(out)
    done = compared(paths, columns, comparison)
    if done.studies and json:
        print(comparison.as_json(done.studies))
    elif done.studies:
        comparison.show(done.studies)
    if done.studies and out:
        write_files(out, comparison.files(done.studies))
    for warning in done.warnings:
        Terminal().say(warning)
    if done.problems:
        raise Problem("\n".join(done.problems))


def compared(paths: Sequence[Path], columns: Path | None, comparison: Comparison[S]) -> Compared[S]:
    """Study every sensor of every recording."""
    warm_up()
    done: Compared[S] = Compared()
    with Terminal().bar("Comparing", len(paths)) as bar:
        for path, name in zip(paths, names(paths), strict=True):
            with noted(path, done.problems):
                session = open_recording(path, column_map=columns)
                for sensor in session.sensors.values():
                    with noted(path, done.problems):
                        done.studies.append(studied(walk_of(session, sensor, name), comparison, bar))
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


def studied(walk: Walk, comparison: Comparison[S], bar: Bar) -> S:
    """Study one sensor and show how far it is."""
    return comparison.study(walk, lambda what: bar.show(f"{walk.name}: {what}"))


def write_files(out: Path, texts: Mapping[str, str]) -> None:
    """Write texts by name into a folder that exists."""
    for name, text in texts.items():
        (out / name).write_text(text, encoding="utf-8")
    Terminal().say(f"Written to {out}: {', '.join(texts)}")
