"""Writes a session's sensors to a file, with progress, and says what became of them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.words import counted, duration
from pdr_core.recording import Sensor, Session
from pdr_core.recording.decimation import decimated, kept_of, rate_of_hz
from pdr_core.recording.export import carries_truth, write_recording
from pdr_core.records import ImuBlock, length


def save(
    session: Session, sensors: Sequence[Sensor], output: Path, overwrite: bool, title: str, terminal: Terminal
) -> None:
    """Write the sensors under a name that tells the format, and say what was written and what was not."""
    with terminal.progress(title) as show:
        counts = [Count(sensor, show) for sensor in sensors]
        write_recording(session, [count.sensor for count in counts], output, overwrite)
    for notice in session.notices:
        terminal.say(f"Warning: {notice.text.rstrip('.')}.")
    print(f"Written to {output}: {'; '.join(count.words(output) for count in counts)}.")


def slower(sensor: Sensor, rate_hz: float, terminal: Terminal) -> Sensor:
    """Return the sensor at about this lower rate, and say at which."""
    native_hz = rate_of_hz(sensor)
    keep_every = kept_of(native_hz, rate_hz)
    if keep_every == 1:
        raise Problem(f"{sensor.name} has {native_hz:.1f} Hz: give a --rate of at most half of it, or none")
    terminal.say(f"{sensor.name}: {native_hz / keep_every:.1f} of {native_hz:.1f} Hz, one sample in {keep_every}.")
    return decimated(sensor, keep_every)


class Count:
    """A sensor that counts its samples while they are read."""

    def __init__(self, sensor: Sensor, show: Callable[[str], None]) -> None:
        self.sensor = replace(sensor, read=self._read)
        self._source = sensor
        self._show = show
        self._samples = 0
        self._first_ns = self._last_ns = 0

    def words(self, output: Path) -> str:
        """Return how much was read, and whether the truth went along."""
        truth = self._source.truth
        along = " with its truth" if truth and carries_truth(output, truth) else ""
        return f"{counted(self._samples, 'sample')} of {self._source.name}, {self._passed}{along}"

    @property
    def _passed(self) -> str:
        return duration((self._last_ns - self._first_ns) / NANOSECONDS)

    def _read(self, max_samples: int) -> Iterator[ImuBlock]:
        for piece in self._source.pieces(max_samples):
            yield piece
            self._first_ns = self._first_ns if self._samples else int(piece.stamp_ns[0])
            self._last_ns = int(piece.stamp_ns[-1])
            self._samples += length(piece)
            self._show(f"{self._source.name}: {counted(self._samples, 'sample')}, {self._passed}")
