"""What a picture of the detectors shows of one recording, thinned to what a screen can show."""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import nanoseconds, seconds_between
from pdr_core.evaluation import dropouts
from pdr_core.evaluation.score import in_order
from pdr_core.records import Flags, Floats, StanceBlock, Truth, TruthKind

STRETCHES = 1_500  # of one curve: each shows its least and its largest value
SPEED_OVER_S = 0.02  # of motion capture: the difference of two neighbours is noise and jitter of the stamps


class Curve(NamedTuple):
    """A line through m points."""

    time_s: Floats  # (m,)
    value: Floats  # (m,)


class DetectorCurves(NamedTuple):
    """One detector on one recording."""

    detector: str
    statistic: Curve
    threshold: Curve
    stance_s: dict[str, Floats]  # by time gate: start and end of each stance, (k, 2)


def detector_curves(detector: str, judged: dict[str, StanceBlock]) -> DetectorCurves:
    """Return the curves of a detector; `judged`, by time gate, at least one, are verdicts on the same samples."""
    first = next(iter(judged.values()))
    stamp_ns = first.imu.stamp_ns
    time_s = seconds_between(stamp_ns, int(stamp_ns[0]))
    stances = {gate: intervals_s(time_s, block.stance) for gate, block in judged.items()}
    return DetectorCurves(
        detector, envelope(time_s, first.statistic), without_middles(*envelope(time_s, first.threshold)), stances
    )


def envelope(time_s: Floats, value: Floats) -> Curve:
    """Return the least and the largest value of each stretch, in the order in which they come: no spike is lost.

    What is not finite becomes one NaN of its stretch.
    """
    value = np.where(np.isfinite(value), value, np.nan)
    if len(value) <= 2 * STRETCHES:
        return Curve(time_s, value)
    rows: list[int] = []
    for stretch in np.array_split(np.arange(len(value)), STRETCHES):
        known, unknown = stretch[~np.isnan(value[stretch])], stretch[np.isnan(value[stretch])]
        extremes = [known[np.argmin(value[known])], known[np.argmax(value[known])]] if len(known) else []
        rows += sorted({*extremes, *unknown[:1]})
    return Curve(time_s[rows], value[rows])


def without_middles(time_s: Floats, value: Floats) -> Curve:
    """Return the points without those that lie between two equal ones: a constant keeps its two ends."""
    same = value[1:] == value[:-1]
    keep = np.ones(len(value), dtype=np.bool_)
    keep[1:-1] = ~(same[:-1] & same[1:])
    return Curve(time_s[keep], value[keep])


def intervals_s(time_s: Floats, stance: Flags) -> Floats:
    """Return start and end [s] of each run of stance samples, (k, 2); the end is the first sample after it."""
    edge = np.diff(np.concatenate([[False], stance, [False]]).astype(np.int8))
    start, stop = np.flatnonzero(edge == 1), np.flatnonzero(edge == -1)
    return np.column_stack([time_s[start], time_s[np.minimum(stop, len(time_s) - 1)]])


def true_speed(truth: Truth | None, start_ns: int) -> Curve | None:
    """Return the speed [m/s] of the foot over the time since `start_ns`; NaN where motion capture lost the foot.

    It is the distance over SPEED_OVER_S, or between rows that are farther apart. None: the path is not known.
    """
    if truth is None or truth.kind is not TruthKind.POSITION:
        return None
    known = in_order(truth)
    later = np.searchsorted(known.stamp_ns, known.stamp_ns + nanoseconds(SPEED_OVER_S))
    rows = np.flatnonzero(later < len(later))
    time_s, later = seconds_between(known.stamp_ns, start_ns), later[rows]
    good = dropouts.measured(known.stamp_ns, known.position_m)
    position_m = np.where(good[:, None], known.position_m, np.nan)
    moved_m = np.linalg.norm(position_m[later] - position_m[rows], axis=1)
    return envelope(0.5 * (time_s[later] + time_s[rows]), moved_m / (time_s[later] - time_s[rows]))
