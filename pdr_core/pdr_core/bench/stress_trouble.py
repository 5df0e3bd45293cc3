"""The troubles of the stress test: what becomes of the samples of a walk, and which of them can be scored."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.bench.stress_ranges import STRIDES_BACK, Ranges
from pdr_core.bench.stress_walk import NO_TROUBLE, Drawn, sensed_walk, walked_m
from pdr_core.records import Floats, ImuBlock
from pdr_core.simulation import SimulatedWalk
from pdr_core.simulation.curve import Curve

KNOT_S = 0.1  # of the tumbling


class Ordeal(NamedTuple):
    """What the suite gets, and the truth of it."""

    imu: ImuBlock
    position_m: Floats  # (n, 3)
    parts: list[tuple[int, int]]  # first and last + 1 row of what is scored, each part aligned by itself


class Site(NamedTuple):
    """Where a trouble is, and what it may use."""

    drawn: Drawn
    walk: SimulatedWalk
    begin: int
    rng: np.random.Generator
    ranges: Ranges


def ordeal(d: Drawn, ranges: Ranges | None = None) -> Ordeal:
    """Return the walk that was drawn, with its trouble."""
    walk = sensed_walk(d)
    imu, position_m = walk.imu, walk.motion.position_m
    if d.trouble == NO_TROUBLE:
        return Ordeal(imu, position_m, [(0, len(position_m))])
    path_m = walked_m(position_m)
    begin = int(np.searchsorted(path_m, d.at * path_m[-1]))
    site = Site(d, walk, begin, np.random.default_rng(d.trouble_seed), ranges or Ranges())
    if not d.trouble.hides_motion:
        imu, kept = TROUBLES_ALL_ALONG[d.trouble.name](site)
        return Ordeal(imu, position_m[kept], [(0, len(kept))])
    stop = begin + round(d.amount * d.rate_hz) if d.trouble.unit == "s" else begin
    imu = HIDING[d.trouble.name](site, stop)
    kept = np.r_[0:begin, stop : len(position_m)] if d.trouble.name == "gap" else np.arange(len(position_m))
    back = int(np.searchsorted(kept, back_again(walk, stop)))
    return Ordeal(ImuBlock(*(column[kept] for column in imu)), position_m[kept], [(0, begin), (back, len(kept))])


def back_again(walk: SimulatedWalk, stop: int) -> int:
    """Return the row at which the stance ends that is `STRIDES_BACK` strides after the first one behind `stop`."""
    stance = walk.motion.stance
    ends = np.flatnonzero(stance[:-1] & ~stance[1:])
    return int(ends[ends >= stop][STRIDES_BACK])


def unseen(site: Site, stop: int) -> ImuBlock:
    """Leave the samples; those of a gap are taken out by the caller."""
    return site.walk.imu


def clipped(site: Site, stop: int) -> ImuBlock:
    """Clip far below the range."""
    now, imu, r = slice(site.begin, stop), site.walk.imu, site.ranges
    gyro_radps, accel_mps2 = site.rng.uniform(*r.clipped_radps), site.rng.uniform(*r.clipped_mps2)
    return with_these(
        imu,
        now,
        np.clip(imu.gyro_radps[now], -gyro_radps, gyro_radps),
        np.clip(imu.accel_mps2[now], -accel_mps2, accel_mps2),
    )


def kicked(site: Site, stop: int) -> ImuBlock:
    """Turn the sensor on the foot, between two samples."""
    axis = site.rng.standard_normal(3)
    turned = Rotation.from_rotvec(site.drawn.amount * axis / np.linalg.norm(axis))
    after, later = slice(stop, None), sensed_walk(site.drawn, turned).imu
    return with_these(site.walk.imu, after, later.gyro_radps[after], later.accel_mps2[after])


def fallen(site: Site, stop: int) -> ImuBlock:
    """Tumble, at random but smoothly."""
    imu, sensor, now = site.walk.imu, site.drawn.sensor, slice(site.begin, stop)
    time_s = (np.arange(site.begin, stop) - site.begin) / site.drawn.rate_hz
    knot_s = np.arange(0.0, site.drawn.amount + 2 * KNOT_S, KNOT_S)
    values = site.rng.standard_normal((len(knot_s), 6))
    felt = Curve(knot_s, values).at(time_s)[0]
    gyro, accel = site.ranges.fall_radps * felt[:, :3], site.ranges.fall_mps2 * felt[:, 3:]
    gyro = np.clip(gyro, -sensor.gyro_range_radps, sensor.gyro_range_radps)
    return with_these(imu, now, gyro, np.clip(accel, -sensor.accel_range_mps2, sensor.accel_range_mps2))


def with_these(imu: ImuBlock, rows: slice, gyro_radps: Floats, accel_mps2: Floats) -> ImuBlock:
    """Return the samples with other values in some rows."""
    gyro, accel = imu.gyro_radps.copy(), imu.accel_mps2.copy()
    gyro[rows], accel[rows] = gyro_radps, accel_mps2
    return imu._replace(gyro_radps=gyro, accel_mps2=accel)


def jittered(site: Site) -> tuple[ImuBlock, Floats]:
    """Move every stamp."""
    imu, n = site.walk.imu, len(site.walk.imu.stamp_ns)
    off_s = site.rng.uniform(-1.0, 1.0, n) * site.drawn.amount / site.drawn.rate_hz
    return imu._replace(stamp_ns=imu.stamp_ns + np.rint(1e9 * off_s).astype(np.int64)), np.arange(n)


def lossy(site: Site) -> tuple[ImuBlock, Floats]:
    """Lose single samples."""
    kept = np.flatnonzero(site.rng.random(len(site.walk.imu.stamp_ns)) >= site.drawn.amount)
    return ImuBlock(*(column[kept] for column in site.walk.imu)), kept


HIDING: dict[str, Callable[[Site, int], ImuBlock]] = {
    "gap": unseen,
    "clipped": clipped,
    "kicked": kicked,
    "fall": fallen,
}
TROUBLES_ALL_ALONG: dict[str, Callable[[Site], tuple[ImuBlock, Floats]]] = {"jitter": jittered, "lost": lossy}
