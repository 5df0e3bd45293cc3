"""One track against another: the figures of `pdr evaluate`, and those that evo gives for the same pairs."""

import json
import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation import alignment, metrics
from pdr_core.evaluation.words import counted, duration, metres
from pdr_core.records import Floats, Stamps

SEGMENT_M = 1.0
FEWEST = 3  # pairs that a turn in space needs


class Spread(NamedTuple):
    """What distances [m] amount to; NaN of none."""

    rmse_m: float
    mean_m: float
    median_m: float
    max_m: float


@dataclass(frozen=True)
class Comparison:
    """How far the paired rows, n of them, of an estimate and of the truth are from one another."""

    pairs: int
    duration_s: float
    path_true_m: float  # horizontal
    path_estimate_m: float
    ate2_m: float  # horizontal, after turn about the vertical and shift
    ate3_m: float  # all three axes, after the same and the mean z offset
    ate_rigid: Spread  # all three axes, after any turn and shift: evo's `evo_ape tum truth estimate -a`
    rpe: Spread  # error of the distance between the ends of each metre of the true path

    def to_json(self) -> str:
        """Return the figures as JSON text, null for what is unknown."""
        return json.dumps(_plain(self.__dict__), indent=2, allow_nan=False)


def compare(stamp_ns: Stamps, estimate_m: Floats, truth_m: Floats) -> Comparison:
    """Compare rows that belong together: stamps (n,) in order, positions (n, 3); ValueError of fewer than three."""
    if len(stamp_ns) < FEWEST:
        raise ValueError(f"only {counted(len(stamp_ns), 'pair')} of positions")
    laid_m = alignment.rigid(estimate_m, truth_m).apply(estimate_m)
    return Comparison(
        pairs=len(stamp_ns),
        duration_s=float(stamp_ns[-1] - stamp_ns[0]) / NANOSECONDS,
        path_true_m=metrics.path_length_m(truth_m),
        path_estimate_m=metrics.path_length_m(estimate_m),
        ate2_m=metrics.ate2_m(estimate_m, truth_m),
        ate3_m=metrics.ate3_m(estimate_m, truth_m),
        ate_rigid=spread(np.linalg.norm(laid_m - truth_m, axis=1)),
        rpe=spread(segment_errors_m(estimate_m, truth_m)),
    )


def segment_errors_m(estimate_m: Floats, truth_m: Floats) -> Floats:
    """Return by how much the distance between the ends of each metre of true path is off, (segments,)."""
    steps_m = np.linalg.norm(np.diff(truth_m, axis=0), axis=1)
    along_m = np.concatenate([[0.0], np.cumsum(steps_m)])
    ends = np.searchsorted(along_m, np.arange(0.0, along_m[-1], SEGMENT_M))
    true_m, estimated_m = (np.linalg.norm(np.diff(track[ends], axis=0), axis=1) for track in (truth_m, estimate_m))
    return np.abs(estimated_m - true_m)


def spread(distance_m: Floats) -> Spread:
    """Return what distances, (n,), amount to."""
    if not len(distance_m):
        return Spread(*[math.nan] * 4)
    rmse_m = float(np.sqrt(np.mean(distance_m**2)))
    return Spread(rmse_m, float(distance_m.mean()), float(np.median(distance_m)), float(distance_m.max()))


def in_words(result: Comparison) -> str:
    """Return the figures as lines of text."""
    rigid, rpe = result.ate_rigid, result.rpe
    return "\n".join(
        [
            f"{counted(result.pairs, 'pair')} over {duration(result.duration_s)}; horizontal path "
            f"{metres(result.path_estimate_m)}, in truth {metres(result.path_true_m)}.",
            f"ATE2 {result.ate2_m:.4f} m: horizontal RMSE after the best turn about the vertical and shift",
            f"ATE3 {result.ate3_m:.4f} m: the same in all three axes",
            f"ATE  {rigid.rmse_m:.4f} m: RMSE in all three axes after the best turn in space and shift, as evo_ape -a "
            f"(mean {rigid.mean_m:.4f}, median {rigid.median_m:.4f}, max {rigid.max_m:.4f})",
            f"RPE  {rpe.rmse_m:.4f} m: RMSE of the distance gained in each metre of the true path "
            f"(mean {rpe.mean_m:.4f}, median {rpe.median_m:.4f}, max {rpe.max_m:.4f})",
        ]
    )


def _plain(value: Any) -> Any:
    if isinstance(value, Spread):
        return _plain(value._asdict())
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    return None if isinstance(value, float) and not math.isfinite(value) else value
