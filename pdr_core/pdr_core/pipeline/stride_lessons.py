"""Brings together a stride that the accelerometer shows and the step by which the filter has measured it.

Which of the two is known first differs from stride to stride, so both wait here; the model learns from the pair.
"""

from collections import deque

from pdr_core.conventions import nanoseconds
from pdr_core.pipeline.gait_model import GaitModel
from pdr_core.pipeline.gait_watch import SeenStride
from pdr_core.pipeline.recent_track import RecentTrack, yaw_of
from pdr_core.records import StepEvent

FORGOTTEN_NS = nanoseconds(3.0)  # a stride and its measurement that have not met by then do not belong together


class StrideLessons:
    """Strides and steps in; the model learns from those that belong together."""

    def __init__(self, model: GaitModel, track: RecentTrack) -> None:
        self._model, self._track = model, track
        self.forget()

    def forget(self) -> None:
        """Wait for nothing: another clock, or another start."""
        self._seen: deque[SeenStride] = deque()  # that wait for their step
        self._steps: deque[StepEvent] = deque()  # that wait for their stride

    def see(self, stride: SeenStride) -> None:
        """Take the next stride."""
        self._seen.append(stride)

    def take(self, steps: list[StepEvent]) -> None:
        """Take the next steps, which are certain."""
        self._steps += steps

    def learn(self, now_ns: int, north: bool) -> None:
        """Let the model learn from the strides whose step is certain.

        `north`: the yaw is good enough to learn from it where the field points.
        """
        while self._steps:
            step = self._steps[0]
            pairs = [s for s in self._seen if step.start_ns < s.step.stamp_ns <= step.stamp_ns]
            if not pairs and 0 <= now_ns - step.stamp_ns < FORGOTTEN_NS:
                return
            self._steps.popleft()
            if len(pairs) == 1 and (ends := self._track.ends(pairs[0])):
                self._model.learn(pairs[0], step, yaw_of(ends[0]), yaw_of(ends[1]), north)
            while self._seen and self._seen[0].step.stamp_ns <= step.stamp_ns:
                self._seen.popleft()
