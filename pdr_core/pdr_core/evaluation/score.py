"""A track against what is known of the truth, gathered piece by piece while the track is made."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pdr_core.conventions import NO_STAMP, seconds_between
from pdr_core.evaluation import alignment, dropouts, metrics
from pdr_core.evaluation.resample import AtStamps
from pdr_core.records import Flags, Floats, NavBlock, Stamps, StepEvent, Truth, TruthKind


@dataclass(frozen=True)
class TruthScore:
    """How far the track is from the truth; NaN where that truth cannot tell."""

    kind: TruthKind
    ate2_m: float = math.nan
    ate3_m: float = math.nan
    end_error_m: float = math.nan
    end_error_percent: float = math.nan
    stride_count_true: int = 0  # STRIDES only
    stride_ate2_m: float = math.nan  # STRIDES only


@dataclass(frozen=True)
class TruthView:
    """Estimate and truth row by row for the pictures: every covered row, NaN where the truth is no measurement."""

    kind: TruthKind
    time_s: Floats  # (n,) since the first estimate
    estimate_m: Floats  # (n, 3), or (n, 2) for STRIDES
    truth_m: Floats  # the same shape, laid onto the estimate as ATE2 does


class Scorer:
    """Takes every estimate once and keeps the positions at the truth's stamps, the first and the last position."""

    def __init__(self, truth: Truth | None) -> None:
        """Rows of the truth that are not later than all before them are left out."""
        truth = in_order(truth) if truth and len(truth.stamp_ns) else truth
        self._truth = truth
        self._resampled = AtStamps(truth.stamp_ns if truth else np.empty(0, dtype=np.int64))
        self._start_ns: int | None = None
        self._latest_ns = NO_STAMP
        self.start_position_m: Floats = np.full(3, np.nan)
        self.end_position_m: Floats = np.full(3, np.nan)

    def add(self, nav: NavBlock) -> None:
        """Take the next estimates."""
        if len(nav.stamp_ns) == 0:
            return
        if self._start_ns is None:
            self._start_ns = int(nav.stamp_ns[0])
            self.start_position_m = nav.position_m[0].copy()
        self.end_position_m = nav.position_m[-1].copy()
        later = ascending(nav.stamp_ns, self._latest_ns)
        self._latest_ns = max(self._latest_ns, int(nav.stamp_ns.max()))
        self._resampled.add(nav.stamp_ns[later], nav.position_m[later])

    @property
    def closure_2d_m(self) -> float:
        """Horizontal distance from the first to the last position."""
        return metrics.closure_2d_m(self.start_position_m, self.end_position_m)

    @property
    def closure_3d_m(self) -> float:
        """Distance from the first to the last position."""
        return metrics.closure_3d_m(self.start_position_m, self.end_position_m)

    def score(self, steps: Sequence[StepEvent], start_position_m: Floats) -> TruthScore | None:
        """Return the score, or None without truth; `start_position_m` (3,) is the foot before step 1."""
        if self._truth is None:
            return None
        if self._truth.kind is TruthKind.CLOSED_LOOP:
            share = metrics.percent(self.closure_2d_m, metrics.stride_distance_m(steps))
            return TruthScore(TruthKind.CLOSED_LOOP, end_error_m=self.closure_2d_m, end_error_percent=share)
        _, estimate_m, truth_m = self._rows(self._truth, steps, start_position_m)
        known = np.isfinite(truth_m).all(axis=1)
        if self._truth.kind is TruthKind.STRIDES:
            return _score_of_strides(estimate_m[known], truth_m[known], len(self._truth.position_m) - 1)
        return _score_of_positions(estimate_m[known], truth_m[known])

    def view(self, steps: Sequence[StepEvent], start_position_m: Floats) -> TruthView | None:
        """Return estimate and truth for the pictures, or None where there are no two rows to compare."""
        if self._truth is None or self._start_ns is None:
            return None
        stamp_ns, estimate_m, truth_m = self._rows(self._truth, steps, start_position_m)
        known = np.isfinite(truth_m).all(axis=1)
        if np.count_nonzero(known) < 2:
            return None
        laid_m = alignment.over_whole(truth_m[known], estimate_m[known]).apply(truth_m)
        return TruthView(self._truth.kind, seconds_between(stamp_ns, self._start_ns), estimate_m, laid_m)

    def _rows(
        self, truth: Truth, steps: Sequence[StepEvent], start_position_m: Floats
    ) -> tuple[Stamps, Floats, Floats]:
        """Return stamps (n,), estimate and truth, (n, 3) or (n, 2), that belong together; truth NaN at dropouts."""
        if truth.kind is TruthKind.STRIDES:
            return _paired(truth, steps, start_position_m)
        rows = self._resampled.covered
        good = dropouts.measured(truth.stamp_ns, truth.position_m)[rows]
        truth_m = np.where(good[:, None], truth.position_m[rows], np.nan)
        return truth.stamp_ns[rows], self._resampled.position_m[rows], truth_m


def start_of_steps_m(steps: Sequence[StepEvent], otherwise_m: Floats) -> Floats:
    """Return where the foot stood before step 1, (3,); `otherwise_m` where there is no step."""
    return steps[0].position_m - steps[0].displacement_m if steps else otherwise_m


def ascending(stamp_ns: Stamps, before_ns: int) -> Flags:
    """Return which stamps, (n,), are later than `before_ns` and all before them."""
    latest_ns = np.maximum.accumulate(np.concatenate([[before_ns], stamp_ns]))
    return stamp_ns > latest_ns[:-1]


def in_order(truth: Truth) -> Truth:
    """Return the truth without the rows that come late."""
    rows = ascending(truth.stamp_ns, NO_STAMP)
    return replace(truth, stamp_ns=truth.stamp_ns[rows], position_m=truth.position_m[rows])


def _paired(truth: Truth, steps: Sequence[StepEvent], start_position_m: Floats) -> tuple[Stamps, Floats, Floats]:
    """Return the ends of the stances beside the truth's rows, in order, over the common length; row 0 is the start."""
    rows = min(len(steps) + 1, len(truth.position_m))
    footfalls_m = np.array([start_position_m, *(step.position_m for step in steps)])
    stamp_ns = np.array([*(step.start_ns for step in steps[:1]), *(step.stamp_ns for step in steps)], dtype=np.int64)
    return stamp_ns[:rows], footfalls_m[:rows, :2], truth.position_m[:rows, :2]


def _score_of_positions(estimate_m: Floats, truth_m: Floats) -> TruthScore:
    return TruthScore(
        TruthKind.POSITION,
        ate2_m=metrics.ate2_m(estimate_m, truth_m),
        ate3_m=metrics.ate3_m(estimate_m, truth_m),
        end_error_m=metrics.end_error_m(estimate_m, truth_m),
        end_error_percent=metrics.end_error_percent(estimate_m, truth_m),
    )


def _score_of_strides(estimate_m: Floats, truth_m: Floats, strides: int) -> TruthScore:
    ate2_m = metrics.ate2_m(estimate_m, truth_m)
    start_path_m = metrics.START_PATH_OF_STRIDES_M
    return TruthScore(
        TruthKind.STRIDES,
        ate2_m=ate2_m,
        end_error_m=metrics.end_error_m(estimate_m, truth_m, start_path_m),
        end_error_percent=metrics.end_error_percent(estimate_m, truth_m, start_path_m),
        stride_count_true=strides,
        stride_ate2_m=ate2_m,
    )
