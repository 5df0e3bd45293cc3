"""What the heading constraints made of one recording, as Gui Table 3 has it, and of the same one with bends."""

from dataclasses import dataclass, field

from pdr_core.records import Floats


@dataclass(frozen=True)
class HeadingScore:
    """One variant on one recording; NaN where its truth cannot tell."""

    ate2_m: float
    end_error_m: float  # closure, where no more is known than that the walk ends where it began
    end_error_percent: float
    strides: int
    held: int  # strides by which a constraint has told the filter its yaw


@dataclass(frozen=True)
class BentScore:
    """A walk turned by an angle in one stride, as if its corridor had a bend."""

    stride: int  # counted from 1
    angle_deg: float
    ate2_m: dict[str, float]  # by constraint


@dataclass(frozen=True)
class HeadingStudy:
    """One recording by every variant."""

    recording: str
    distance_m: float  # as the first variant has it
    scores: dict[str, HeadingScore]  # by variant
    bends: list[BentScore] = field(default_factory=list)  # where the truth is known at strides
    tracks_m: dict[str, Floats] = field(default_factory=dict)  # (n, 2) by variant, laid onto the truth
    truth_m: Floats | None = None  # (n, 2)
