"""What an opened recording is: sensors that can be read in pieces, and notices that grow while they are read."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from pdr_core.records import ImuBlock, Level, Notice, Stamps, Truth
from pdr_core.records_external import FixBlock

DEFAULT_PIECE = 65536


class Arrivals(NamedTuple):
    """Somebody else's fixes in the order of the file."""

    fixes: FixBlock
    after_samples: Stamps  # (n, sensors) so many samples of each sensor stood before them


class RecordingError(Exception):
    """A recording cannot be opened; the message says in one sentence what to do next."""


@dataclass(frozen=True)
class Sensor:
    """One inertial sensor of a recording, and what is known of where it really was."""

    name: str
    truth: Truth | None
    read: Callable[[int], Iterator[ImuBlock]]

    def pieces(self, max_samples: int = DEFAULT_PIECE) -> Iterator[ImuBlock]:
        """Yield the samples in the order of the file, at most `max_samples` at a time; each call starts anew."""
        return self.read(max_samples)


@dataclass(frozen=True)
class Session:
    """An opened recording. `notices` grows while its sensors are read."""

    name: str
    path: Path
    format: str
    sensors: dict[str, Sensor]
    notices: list[Notice] = field(default_factory=list)
    beside: Mapping[str, FixBlock] = field(default_factory=dict)  # somebody else's fixes by topic, to be written too
    arrivals: Callable[[Sequence[str], str], Arrivals] | None = None  # of sensors and a topic; None: it has no topics


def put_warning(notices: list[Notice], kind: str, text: str, count: int, first_stamp_ns: int) -> None:
    """Add a warning, or renew the one of the same kind and text: reading twice does not say it twice."""
    notice = Notice(Level.WARN, kind, text, count, first_stamp_ns)
    for i, other in enumerate(notices):
        if (other.kind, other.text) == (kind, text):
            notices[i] = notice
            return
    notices.append(notice)
