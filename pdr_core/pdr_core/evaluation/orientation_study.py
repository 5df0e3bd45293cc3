"""What the methods of orientation made of one recording: figures, and curves where heel and toe are known."""

from dataclasses import dataclass, field

from pdr_core.evaluation.walk_score import WalkScore
from pdr_core.records import Floats


@dataclass(frozen=True)
class GaitErrors:
    """Strides and foot pitch against two points of the foot, heel and toe."""

    strides_found: int  # true ones, each in one step of its own
    strides_true: int
    strides_false: int  # steps without a true stride of their own
    length_error_m: Floats  # (k,) of the strides found on which the foot turned little
    length_true_m: Floats  # (k,)
    pitch_offset_rad: float  # estimate minus truth in mid-stance, which is taken off
    pitch_rmse_rad: float  # thereafter, from the first stride to the last

    @property
    def mean_m(self) -> float:
        """The mean error of the length."""
        return float(self.length_error_m.mean()) if len(self.length_error_m) else float("nan")

    @property
    def sd_m(self) -> float:
        """The standard deviation of the error of the length."""
        return float(self.length_error_m.std(ddof=1)) if len(self.length_error_m) > 1 else float("nan")

    @property
    def mean_percent(self) -> float:
        """The mean error in percent of the mean length."""
        return 100.0 * self.mean_m / float(self.length_true_m.mean()) if len(self.length_true_m) else float("nan")

    @property
    def sd_percent(self) -> float:
        """The standard deviation in percent of the mean length."""
        return 100.0 * self.sd_m / float(self.length_true_m.mean()) if len(self.length_true_m) else float("nan")


@dataclass(frozen=True)
class PitchCycle:
    """The pitch of the foot from one mid-stance to the next, its offset taken off (Qiu figure 13)."""

    time_s: Floats  # (n,) since the first
    true_rad: Floats  # (n,) toe up is positive
    estimated_rad: dict[str, Floats]  # (n,) each, by method


@dataclass(frozen=True)
class Drift:
    """The velocity of the foot before and after its drift was taken off, forward, left, up (Qiu figure 7)."""

    time_s: Floats  # (n,)
    before_mps: Floats  # (n, 3)
    after_mps: Floats  # (n, 3)


@dataclass(frozen=True)
class OrientationStudy:
    """One recording; the rest only where heel and toe are known."""

    recording: str
    scores: dict[str, WalkScore]  # by method
    left_out: dict[str, str] = field(default_factory=dict)  # methods that cannot run here, and why
    gait: dict[str, GaitErrors] = field(default_factory=dict)
    cycle: PitchCycle | None = None
    drift: Drift | None = None
