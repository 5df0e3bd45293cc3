"""What the stance detectors made of one recording: figures, curves, steps by window, the worth of each part."""

from dataclasses import dataclass, field
from typing import NamedTuple

from pdr_core.evaluation.detector_curves import Curve, DetectorCurves
from pdr_core.evaluation.walk_score import WalkScore
from pdr_core.records import Floats


class Choice(NamedTuple):
    """A detector and what guards it."""

    detector: str
    gate: str


class WindowSteps(NamedTuple):
    """Steps found, by the length of the window."""

    window_s: Floats  # (n,)
    steps: dict[str, list[int]]  # by detector, n each


@dataclass(frozen=True)
class DetectorStudy:
    """One recording; `windows` and `ablation` only where they were asked for, and this where the truth is known."""

    recording: str
    scores: dict[Choice, WalkScore]
    curves: list[DetectorCurves]  # one of each detector
    speed: Curve | None  # of the foot in truth
    windows: WindowSteps | None = None
    ablation: dict[str, WalkScore] = field(default_factory=dict)  # by what is switched off

    @property
    def strides_true(self) -> int | None:
        """How many strides there were, if known."""
        return next(iter(self.scores.values())).strides_true
