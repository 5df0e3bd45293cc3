"""Somebody else who follows a simulated person: a frame and a clock of their own, noise, and what goes wrong."""

from dataclasses import dataclass, field

import numpy as np
from scipy.ndimage import uniform_filter1d

from pdr_core.conventions import NANOSECONDS, nanoseconds
from pdr_core.records import Flags, Floats, Truth
from pdr_core.records_external import FixBlock, about_up

STRIDE_NS = 1_100_000_000
WALKS_M = 0.3
Span = tuple[float, float]  # from, until [s] since the walk began


@dataclass(frozen=True)
class ExternalSource:
    """How they measure, and what goes wrong when."""

    rate_hz: float = 1.0
    noise_sd_m: float = 0.3
    yaw_rad: float = 2.0  # their frame from that of the truth
    shift_m: tuple[float, float, float] = (30.0, -12.0, 1.5)
    clock_s: float = 0.4  # their stamps are ahead by so much
    beside_m: tuple[float, float] = (0.0, 0.0)  # they go so far ahead and to the left of the person
    tells_noise: bool = True  # their covariance says what their noise is
    silent: tuple[Span, ...] = ()
    frozen: tuple[Span, ...] = ()
    outliers_s: tuple[float, ...] = ()  # the fix after each lies `outlier_m` off
    outlier_m: float = 100.0
    drifts: Span = field(default=(np.inf, np.inf))  # in this time they go away by `drift_mps`, then stay off
    drift_mps: float = 0.1
    back_s: float = np.inf  # and from here they are right again


def fixes(truth: Truth, source: ExternalSource, seed: int = 0) -> FixBlock:
    """Return what they say of a person who is where the truth says: in order, stamped by their clock."""
    t = (truth.stamp_ns - truth.stamp_ns[0]) / NANOSECONDS
    at_s = np.arange(0.37 / source.rate_hz, t[-1], 1.0 / source.rate_hz)
    rng = np.random.default_rng([seed, 10])
    ahead = np.interp(at_s, t, walks_rad(truth))
    true_m = np.column_stack([np.interp(at_s, t, axis_m) for axis_m in truth.position_m.T])
    true_m += np.array([about_up(yaw_rad) @ [*source.beside_m, 0.0] for yaw_rad in ahead])
    position_m = true_m @ about_up(source.yaw_rad).T + np.array(source.shift_m)
    position_m += source.noise_sd_m * rng.standard_normal(position_m.shape)
    position_m[:, 0] += drifted_m(at_s, source)
    for outlier_s in source.outliers_s:
        position_m[int(np.searchsorted(at_s, outlier_s)), :2] += source.outlier_m / np.sqrt(2.0)
    position_m = as_frozen(position_m, [within(at_s, [span]) for span in source.frozen])
    heard = ~within(at_s, source.silent)
    stamp_ns = truth.stamp_ns[0] + np.rint(at_s * NANOSECONDS).astype(np.int64) + nanoseconds(source.clock_s)
    variance_m2 = np.full(position_m.shape, source.noise_sd_m**2 if source.tells_noise else 0.0)
    return FixBlock(stamp_ns[heard], position_m[heard], variance_m2[heard], (ahead + source.yaw_rad)[heard])


def walks_rad(truth: Truth) -> Floats:
    """Return where one walks, (n,), continuous: the direction over a stride, or while she stands the one before."""
    half = STRIDE_NS // 2
    ends = [
        np.column_stack([np.interp(truth.stamp_ns + s * half, truth.stamp_ns, x) for x in truth.position_m.T[:2]])
        for s in (-1, 1)
    ]
    way = ends[1] - ends[0]
    moving = np.linalg.norm(way, axis=1) > WALKS_M
    if not moving.any():
        return np.zeros(len(way))
    last = np.maximum.accumulate(np.where(moving, np.arange(len(way)), int(moving.argmax())))
    return np.unwrap(np.arctan2(way[last, 1], way[last, 0]))


def drifted_m(at_s: Floats, source: ExternalSource) -> Floats:
    """Return by how much they have gone away by times (n,)."""
    begin_s, end_s = source.drifts
    gone_s = np.maximum(np.minimum(at_s, end_s) - begin_s, 0.0)
    return np.where(at_s < source.back_s, source.drift_mps * gone_s, 0.0)


def within(at_s: Floats, spans: list[Span] | tuple[Span, ...]) -> Flags:
    """Tell which times (n,) lie in one of the spans."""
    inside = np.zeros(len(at_s), np.bool_)
    for begin_s, end_s in spans:
        inside |= (at_s >= begin_s) & (at_s < end_s)
    return inside


def as_frozen(position_m: Floats, frozen: list[Flags]) -> Floats:
    """Return positions (n, 3) that stay at the first one of each span."""
    out = position_m.copy()
    for span in frozen:
        out[span] = out[int(np.argmax(span))]
    return out


def midway(left: Truth, right: Truth) -> Truth:
    """Return the truth of the body midway between two feet with the same stamps."""
    return Truth(left.kind, left.stamp_ns, 0.5 * (left.position_m + right.position_m))


def body_of(foot: Truth) -> Truth:
    """Return about where the body above one foot is: the mean of the foot over a stride."""
    samples = max(1, round(STRIDE_NS / float(np.median(np.diff(foot.stamp_ns)))))
    return Truth(foot.kind, foot.stamp_ns, uniform_filter1d(foot.position_m, samples, axis=0, mode="nearest"))
