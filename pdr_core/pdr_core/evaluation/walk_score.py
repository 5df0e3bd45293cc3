"""One walk in the figures of a table, and many walks in the figures of one row."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pdr_core.evaluation.score import Scorer, start_of_steps_m
from pdr_core.records import Flags, StepEvent, TruthKind

FAILED_M = 1.0  # a track that is farther off is lost


@dataclass(frozen=True)
class WalkScore:
    """What a setting made of one recording; NaN or None where its truth cannot tell."""

    truth: str  # kind of it, or "none"
    strides: int
    strides_true: int | None
    ate2_m: float
    ate3_m: float
    stride_ate2_m: float  # at the ends of the true strides
    closure_2d_m: float  # from the first position to the last, where no true position is known
    closure_3d_m: float
    stance_share: float  # of the samples

    @property
    def error_m(self) -> float:
        """The ATE2 at every sample, or at the strides where only these are known."""
        return self.ate2_m if math.isfinite(self.ate2_m) else self.stride_ate2_m

    @property
    def strides_wrong(self) -> int:
        """By how many strides the count is off; 0 where the true count is not known."""
        return 0 if self.strides_true is None else abs(self.strides - self.strides_true)


@dataclass(frozen=True)
class Summary:
    """A setting over many recordings; NaN where none can tell."""

    recordings: int  # whose true path is known
    mean_m: float  # of their ATE2
    median_m: float
    worst_m: float
    failed: int  # over FAILED_M, or no number
    counted: int  # recordings whose strides are known
    strides_wrong: int  # by how many the count of each is off, added up
    loops: int  # recordings that end where they began
    closure_2d_m: float  # their mean
    closure_3d_m: float


def walk_score(scorer: Scorer, steps: Sequence[StepEvent], stance: Flags) -> WalkScore:
    """Return the figures of a track that the scorer has taken, with its steps and its verdicts, (n,)."""
    known = scorer.score(steps, start_of_steps_m(steps, scorer.start_position_m))
    kind = known.kind if known else None
    at_rows, at_strides = kind is TruthKind.POSITION, kind is TruthKind.STRIDES
    unknown = (math.nan, math.nan)
    return WalkScore(
        kind.value if kind else "none",
        len(steps),
        known.stride_count_true if known and at_strides else None,
        known.ate2_m if known and at_rows else math.nan,
        known.ate3_m if known and at_rows else math.nan,
        known.stride_ate2_m if known and at_strides else math.nan,
        *(unknown if at_rows or at_strides else (scorer.closure_2d_m, scorer.closure_3d_m)),
        float(np.mean(stance)) if len(stance) else math.nan,
    )


def summary(scores: Sequence[WalkScore]) -> Summary:
    """Return what the scores of many recordings amount to."""
    tracked = [s.error_m for s in scores if s.truth in (TruthKind.POSITION.value, TruthKind.STRIDES.value)]
    known = [error_m for error_m in tracked if math.isfinite(error_m)]
    mean_m, median_m, worst_m = (float(f(known)) if known else math.nan for f in (np.mean, np.median, np.max))
    loops = [s for s in scores if s.truth == TruthKind.CLOSED_LOOP.value]
    closures = [(s.closure_2d_m, s.closure_3d_m) for s in loops] or [(math.nan, math.nan)]
    return Summary(
        len(tracked),
        mean_m,
        median_m,
        worst_m,
        sum(not error_m <= FAILED_M for error_m in tracked),
        sum(s.strides_true is not None for s in scores),
        sum(s.strides_wrong for s in scores),
        len(loops),
        *(float(x) for x in np.mean(closures, axis=0)),
    )
