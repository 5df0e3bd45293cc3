"""Strides in the figures of gait analysis (Qiu sections 2.3 and 3), as they come, in bounded memory.

The pitch of the foot needs the walking direction in foot axes, which the first straight strides tell (see
`installation`). Strides wait until it is known, but never more than WAITING of them: what is older goes without.
"""

import math
from collections import deque
from collections.abc import Iterator

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.gait import foot_events, foot_pitch
from pdr_core.gait.foot_events import Marks
from pdr_core.gait.installation import FEWEST, Installation
from pdr_core.gait.samples import Buffer, Cycle
from pdr_core.maths.quaternion import matrix, turn_about_up_rad
from pdr_core.notices import Tally
from pdr_core.records import Level, NavBlock, Notice, StanceBlock, StepEvent
from pdr_core.records_gait import Mounting, Stride

WAITING = 40  # strides
PAUSE_NS = 2_000_000_000  # a foot that stands for longer makes a pause: nobody knows when its stride was over
DIRECTION_MIN_M = 0.2  # a shorter displacement has no direction to speak of


class StrideAnalysis:
    """Samples, estimates and steps in, strides out."""

    def __init__(self) -> None:
        self._buffer = Buffer()
        self._installation = Installation()
        self._steps: deque[StepEvent] = deque()  # whose samples are still to come
        self._waiting: deque[tuple[StepEvent, Cycle, Marks]] = deque()
        self._heading_rad: float | None = None
        self._tally = Tally()
        self.mounting: Mounting | None = None
        self._ahead = np.zeros(3)  # the walking direction in foot axes, once the mounting is known

    def run(self, judged: StanceBlock, nav: NavBlock, steps: list[StepEvent]) -> list[Stride]:
        """Take the next samples and steps; return the strides that are known with them."""
        self._buffer.add(judged, nav)
        self._steps += steps
        strides: list[Stride] = []
        while self._steps and self._buffer.holds(self._steps[0]):
            strides += self._next()
        self._buffer.forget()
        return strides

    def finish(self) -> list[Stride]:
        """Return the strides that still wait for the mounting, with what the strides so far tell of it."""
        if self.mounting is None and self._waiting:
            self._mount(self._installation.found(FEWEST))
        if self.mounting is None and self._waiting:
            text = f"the pitch of the foot is not known: {self._installation.doubt(FEWEST)}"
            self._tally.add("no_mounting", Level.OK, text, self._waiting[0][0].stamp_ns)
        strides = [self._stride(*waiting) for waiting in self._waiting]
        self._waiting.clear()
        return strides

    @property
    def notices(self) -> list[Notice]:
        """What could not be told."""
        return self._tally.notices

    def _next(self) -> Iterator[Stride]:
        """Take the next step and yield the strides that need not wait any longer."""
        step = self._steps.popleft()
        cycle = self._buffer.take(step)
        marks = foot_events.marks(cycle)
        if self.mounting is None:
            self._installation.add(cycle, marks)
            self._mount(self._installation.found())
        self._waiting.append((step, cycle, marks))
        while self._waiting and (self.mounting or len(self._waiting) > WAITING):
            yield self._stride(*self._waiting.popleft())

    def _mount(self, mounting: Mounting | None) -> None:
        self.mounting, self._ahead = mounting, matrix(mounting.quat_xyzw)[0] if mounting else self._ahead

    def _stride(self, step: StepEvent, cycle: Cycle, marks: Marks) -> Stride:
        quat_xyzw = cycle.samples["quat_xyzw"]
        whole_ns, swing_ns = step.stamp_ns - step.start_ns, marks.heel_strike_ns - marks.toe_off_ns
        timed = whole_ns > 0 and marks.standing_ns <= PAUSE_NS
        swung = marks.seen and swing_ns > 0
        pitch = foot_pitch.over_stride(*cycle, self._ahead) if marks.seen else None
        pitch = pitch if self.mounting else None
        return Stride(
            step,
            duration_s=whole_ns / NANOSECONDS if timed else None,
            stance_s=(whole_ns - swing_ns) / NANOSECONDS if timed and swung else None,
            swing_s=swing_ns / NANOSECONDS if swung else None,
            clearance_m=marks.clearance_m if marks.seen else None,
            turn_rad=turn_about_up_rad(quat_xyzw[marks.flat_before], quat_xyzw[marks.flat_after]),
            heading_change_rad=self._heading_change_rad(step),
            toe_off_ns=marks.toe_off_ns if swung else None,
            heel_strike_ns=marks.heel_strike_ns if swung else None,
            pitch_max_rad=pitch[0] if pitch else None,
            pitch_min_rad=pitch[1] if pitch else None,
            pitch_cycle_rad=pitch[2] if pitch and timed else None,
        )

    def _heading_change_rad(self, step: StepEvent) -> float | None:
        """Return by how much the walk has turned since the stride before, and keep the heading for the next."""
        before_rad, self._heading_rad = self._heading_rad, None
        if step.length_m >= DIRECTION_MIN_M:
            self._heading_rad = step.heading_rad
        if before_rad is None or self._heading_rad is None:
            return None
        return math.remainder(self._heading_rad - before_rad, math.tau)
