"""Strides in the figures of gait analysis (Qiu sections 2.3 and 3), as they come, in bounded memory.

The pitch of the foot needs the walking direction in foot axes, which the first straight strides tell (see
`installation`). Strides wait until it is known, but never more than WAITING of them: what is older goes without.
"""

from collections import deque

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.gait import foot_events, foot_pitch
from pdr_core.gait.foot_events import Marks
from pdr_core.gait.installation import FEWEST, Installation
from pdr_core.gait.samples import Buffer, Cycle
from pdr_core.maths.quaternion import matrix, turn_about_up_rad
from pdr_core.notices import Tally
from pdr_core.records import Floats, Level, Mounting, NavBlock, Notice, StanceBlock, StepEvent, Stride

WAITING = 40  # strides
PAUSE_NS = 2_000_000_000  # a foot that stands for longer makes a pause: nobody knows when its stride was over
DIRECTION_MIN_M = 0.2  # a shorter displacement has no direction to speak of


class StrideAnalysis:
    """Samples, estimates and steps in, strides out."""

    def __init__(self) -> None:
        self._buffer = Buffer()
        self._installation = Installation()
        self._waiting: deque[tuple[StepEvent, Cycle, Marks]] = deque()
        self._heading_rad: float | None = None
        self._tally = Tally()
        self.mounting: Mounting | None = None

    @property
    def _ahead(self) -> Floats | None:
        """The walking direction in foot axes, (3,)."""
        return matrix(self.mounting.quat_xyzw)[0] if self.mounting else None

    def run(self, judged: StanceBlock, nav: NavBlock, steps: list[StepEvent]) -> list[Stride]:
        """Take the next samples, and the steps that are known with them; return the strides that are."""
        self._buffer.add(judged, nav)
        strides = []
        for step in steps:
            cycle = self._buffer.take(step.sample_numbers)
            marks = foot_events.marks(cycle)
            if self.mounting is None:
                self._installation.add(cycle, marks)
                self.mounting = self._installation.found()
            self._waiting.append((step, cycle, marks))
            while self._waiting and (self.mounting or len(self._waiting) > WAITING):
                strides.append(self._stride(*self._waiting.popleft()))
        self._buffer.shorten()
        return strides

    def finish(self) -> list[Stride]:
        """Return the strides that still wait for the mounting, with what the strides so far tell of it."""
        if self.mounting is None and self._waiting:
            self.mounting = self._installation.found(FEWEST)
        if self.mounting is None and self._waiting:
            text = f"the pitch of the foot is not known: {self._installation.doubt(FEWEST)}"
            self._tally.add("no_mounting", Level.OK, text, 0)
        strides = [self._stride(*waiting) for waiting in self._waiting]
        self._waiting.clear()
        return strides

    @property
    def notices(self) -> list[Notice]:
        """What could not be told."""
        return self._tally.notices

    def _stride(self, step: StepEvent, cycle: Cycle, marks: Marks) -> Stride:
        s = cycle.samples
        whole_ns = step.stamp_ns - step.start_ns
        paused = whole_ns <= 0 or s.stamp_ns[cycle.last] - s.stamp_ns[marks.landed] > PAUSE_NS
        swing_ns = s.stamp_ns[marks.heel_strike] - s.stamp_ns[marks.toe_off] if marks.seen else 0
        swung, timed = marks.seen and swing_ns > 0, not paused
        largest_rad, smallest_rad = self._pitch_range(cycle) if marks.seen else (None, None)
        return Stride(
            step,
            duration_s=whole_ns / NANOSECONDS if timed else None,
            stance_s=float(whole_ns - swing_ns) / NANOSECONDS if timed and swung else None,
            swing_s=float(swing_ns) / NANOSECONDS if swung else None,
            clearance_m=marks.clearance_m if marks.seen else None,
            turn_rad=turn_about_up_rad(s.quat_xyzw[marks.flat_before], s.quat_xyzw[marks.flat_after]),
            heading_change_rad=self._heading_change_rad(step),
            toe_off_ns=int(s.stamp_ns[marks.toe_off]) if swung else None,
            heel_strike_ns=int(s.stamp_ns[marks.heel_strike]) if swung else None,
            pitch_max_rad=largest_rad,
            pitch_min_rad=smallest_rad,
            pitch_cycle_rad=self._pitch_cycle(cycle) if marks.seen and timed else None,
        )

    def _heading_change_rad(self, step: StepEvent) -> float | None:
        """Return by how much the walk has turned since the stride before, and keep the heading for the next."""
        before_rad, self._heading_rad = self._heading_rad, None
        if step.length_m >= DIRECTION_MIN_M:
            self._heading_rad = step.heading_rad
        if before_rad is None or self._heading_rad is None:
            return None
        return float(np.remainder(self._heading_rad - before_rad + np.pi, 2.0 * np.pi) - np.pi)

    def _pitch_range(self, cycle: Cycle) -> tuple[float, float] | tuple[None, None]:
        return foot_pitch.range_rad(cycle, self._ahead) if self._ahead is not None else (None, None)

    def _pitch_cycle(self, cycle: Cycle) -> Floats | None:
        return foot_pitch.cycle_rad(cycle, self._ahead) if self._ahead is not None else None
