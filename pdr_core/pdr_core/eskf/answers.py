"""The heading observations that the filter waits for: each step event gets one answer, at a moment known before.

A step event names the stamp up to which the filter goes on without the answer. The answer names the stamp, this one or
a later one, from which it applies. So the same samples give the same track, however long the answer took.
"""

import math
from collections.abc import Iterator

import numpy as np

from pdr_core.notices import Tally
from pdr_core.records import HeadingObservation, HeadingSource, Level, Notice, PositionError, StepEvent

NOTHING_DUE_NS = 2**63 - 1
UNASKED = "heading observations answer no step that waits, left out: they come too late, or twice"
UNUSABLE = "heading observations hold NaN or apply before the answer was due: taken as empty"
UNANSWERED = "steps got no heading observation in time: the track goes on without; is heading_fusion running?"


class Answers:
    """Which steps wait for their answer, and which answers wait for their stamp."""

    def __init__(self) -> None:
        self._asked: dict[tuple[int, int], StepEvent] = {}  # by index and stamp of the step
        self._given: list[HeadingObservation] = []
        self._tally = Tally()

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the answers so far."""
        return self._tally.notices

    @property
    def next_ns(self) -> int:
        """The first stamp at which an answer is needed or applies."""
        due = [step.answer_due_ns for step in self._asked.values()]
        return min([*due, *(given.applies_from_ns for given in self._given)], default=NOTHING_DUE_NS)

    def ask(self, step: StepEvent) -> None:
        """Wait for the answer to a step. What was to come later than it belongs to a clock that has jumped back."""
        due_ns = step.answer_due_ns
        self._asked = {key: asked for key, asked in self._asked.items() if asked.answer_due_ns <= due_ns}
        self._given = [given for given in self._given if given.step_ns <= step.stamp_ns]
        self._asked[step.index, step.stamp_ns] = step

    def take(self, answer: HeadingObservation) -> None:
        """Take the answer to a step."""
        step = self._asked.pop((answer.step_index, answer.step_ns), None)
        if step is None:
            self._tally.add("heading_unasked", Level.WARN, UNASKED, answer.step_ns)
        elif not answer.empty and not usable(answer, step):
            self._tally.add("heading_unusable", Level.WARN, UNUSABLE, answer.step_ns)
        elif not answer.empty:
            self._given.append(answer)

    def missing(self, stamp_ns: int) -> bool:
        """Tell whether the sample of this stamp must wait for an answer."""
        return any(step.answer_due_ns <= stamp_ns for step in self._asked.values())

    def applying(self, stamp_ns: int) -> Iterator[HeadingObservation]:
        """Yield the answers that apply now, each once."""
        now = sorted((g for g in self._given if g.applies_from_ns <= stamp_ns), key=lambda g: g.applies_from_ns)
        self._given = [given for given in self._given if given.applies_from_ns > stamp_ns]
        yield from now

    def give_up(self, stamp_ns: int) -> None:
        """Go on without the answers for which the sample of this stamp waits."""
        late = {key: step for key, step in self._asked.items() if step.answer_due_ns <= stamp_ns}
        for key, step in late.items():
            self._tally.add("heading_unanswered", Level.WARN, UNANSWERED, step.stamp_ns)
            del self._asked[key]


def usable(answer: HeadingObservation, step: StepEvent) -> bool:
    """Tell whether an answer can be used, and used the same way however late it came."""
    known = math.isfinite(answer.yaw_error_rad) and 0.0 < answer.yaw_error_sd_rad < math.inf
    heading = known or answer.source is HeadingSource.NONE
    place = answer.position is None or place_usable(answer.position)
    return heading and place and answer.applies_from_ns >= step.answer_due_ns


def place_usable(place: PositionError) -> bool:
    """Tell whether the error of a place is a number and its covariance one."""
    finite = np.isfinite(place.error_m).all() and np.isfinite(place.covariance_m2).all()
    return bool(finite and np.linalg.eigvalsh(place.covariance_m2)[0] > 0.0)
