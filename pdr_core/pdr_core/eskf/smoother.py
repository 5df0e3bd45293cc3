"""Estimates that know the whole recording, in bounded memory: the filter is run again, piece by piece, from the end."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from pdr_core.eskf.settings import Settings
from pdr_core.eskf.smoothing import estimates, smooth
from pdr_core.eskf.state import FilterState
from pdr_core.eskf.tape import Tape, recorded
from pdr_core.records import Flags, NavBlock, StanceBlock, StepEvent, joined, length

SEGMENT = 2048  # the tape of a sample takes 8 kB


@dataclass
class Segment:
    """Samples in a row, with the filter's memory before them and, once known, the smoothed one after them."""

    before: FilterState
    blocks: list[StanceBlock] = field(default_factory=list)
    smoothed_after: FilterState | None = None

    @property
    def numbers(self) -> range:
        """The numbers of its samples, as the filter counts them."""
        first = int(self.before.samples)
        return range(first, first + sum(length(block) for block in self.blocks))


class Smoother:
    """Keeps what the filter was given, and smooths it from the end. It takes 130 bytes a sample."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._segments: list[Segment] = []

    def keep(self, before: FilterState, block: StanceBlock) -> None:
        """Keep samples, none of which waits for an answer, and a copy of the filter's memory before them."""
        if not self._segments or len(self._segments[-1].numbers) >= SEGMENT:
            self._segments.append(Segment(before))
        self._segments[-1].blocks.append(block)

    def smoothed(
        self, last: FilterState, steps: list[StepEvent], seen: Callable[[float], object]
    ) -> Iterator[tuple[StanceBlock, NavBlock, list[StepEvent]]]:
        """Yield samples with their smoothed estimates and steps, in order; `last` is the filter's memory at the end.

        First from the end to the beginning for the state at the borders, then forward. `seen` is told the share done.
        """
        ends = np.array(sorted({number for step in steps for number in step.sample_numbers}), np.int64)
        done, after = 0, last.copy()
        for segment in reversed(self._segments):
            segment.smoothed_after = after
            _, tape, _ = self._smoothed(segment, ends)
            after = tape.states[0].copy()
            seen((done := done + 1) / (2 * len(self._segments)))
        stands: dict[int, FilterState] = {}
        for segment in self._segments:
            block, tape, flags = self._smoothed(segment, ends)
            stands |= {segment.numbers[i]: tape.states[i + 1].copy() for i in np.flatnonzero(flags)}
            mine = [self._restated(step, stands) for step in steps if step.sample_numbers[1] in segment.numbers]
            seen((done := done + 1) / (2 * len(self._segments)))
            yield block, estimates(tape), mine

    def _smoothed(self, segment: Segment, ends: np.ndarray) -> tuple[StanceBlock, Tape, Flags]:
        block, numbers = joined(segment.blocks), segment.numbers
        tape, flags = recorded(block, self._settings, segment.before), np.zeros(len(numbers), np.bool_)
        flags[ends[(ends >= numbers.start) & (ends < numbers.stop)] - numbers.start] = True
        tape.states[-1] = segment.smoothed_after
        smooth(tape, flags, self._settings.level_ground)
        return block, tape, flags

    def _restated(self, step: StepEvent, stands: dict[int, FilterState]) -> StepEvent:
        """Return a step as the smoothed states at its beginning and its end have it."""
        start, end = (stands[number] for number in step.sample_numbers)
        covariance = start["displacement_covariance"].copy()
        if self._settings.level_ground:  # the height is the filter's
            covariance[2, :] = covariance[:, 2] = 0.0
            covariance[2, 2] = step.displacement_covariance_m2[2, 2]
        return replace(
            step,
            position_m=end["end_position_m"][1].copy(),
            displacement_m=end["end_position_m"][1] - start["end_position_m"][1],
            displacement_covariance_m2=covariance,
            yaw_rad=float(end["end_yaw_rad"][1]),
            yaw_sd_rad=float(end["end_yaw_sd_rad"][1]),
        )
