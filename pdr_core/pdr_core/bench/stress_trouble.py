"""The troubles of the stress test: what becomes of the samples of a walk, and which of them can be scored."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pdr_core.bench.stress_ranges import RANGES, STRIDES_BACK
from pdr_core.bench.stress_walk import NO_TROUBLE, Drawn, sensed_walk, walked_m
from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Floats, ImuBlock
from pdr_core.simulation import SimulatedWalk
from pdr_core.simulation.curve import Curve

KNOT_S = 0.1  # of the tumbling
Rows = NDArray[np.intp]


class Ordeal(NamedTuple):
    """What the suite gets, and the truth of it."""

    imu: ImuBlock
    position_m: Floats  # (n, 3)
    parts: list[tuple[int, int]]  # first and last + 1 row of what is scored, each part aligned by itself


class Site(NamedTuple):
    """Where a trouble is, and what it may use."""

    drawn: Drawn
    walk: SimulatedWalk
    begin: int  # first and last + 1 row of a trouble that does not last all along
    stop: int
    rng: np.random.Generator


def ordeal(d: Drawn) -> Ordeal:
    """Return the walk that was drawn, with its trouble."""
    walk = sensed_walk(d)
    path_m = walked_m(walk.motion.position_m)
    begin = int(np.searchsorted(path_m, d.at * path_m[-1]))
    stop = begin + (round(d.amount * d.rate_hz) if d.trouble.unit == "s" else 0)
    imu, kept = AFFECTED[d.trouble.name](Site(d, walk, begin, stop, np.random.default_rng(d.trouble_seed)))
    ends = [0, begin, *back_again(walk, stop), len(path_m)] if d.trouble.hides_motion else [0, len(path_m)]
    rows = [int(row) for row in np.searchsorted(kept, ends)]
    parts = list(zip(rows[::2], rows[1::2], strict=False))
    return Ordeal(ImuBlock._make(column[kept] for column in imu), walk.motion.position_m[kept], parts)


def back_again(walk: SimulatedWalk, stop: int) -> list[int]:
    """Return the row at which the stance ends that is `STRIDES_BACK` strides after the first one behind `stop`.

    Where the walk is over before, there is none.
    """
    stance = walk.motion.stance
    ends = np.flatnonzero(stance[:-1] & ~stance[1:])
    return [int(row) for row in ends[ends >= stop][STRIDES_BACK:][:1]]


def untouched(site: Site) -> tuple[ImuBlock, Rows]:
    """Leave everything as it is."""
    return site.walk.imu, np.arange(len(site.walk.imu.stamp_ns))


def interrupted(site: Site) -> tuple[ImuBlock, Rows]:
    """Take samples out."""
    imu, rows = untouched(site)
    return imu, np.delete(rows, slice(site.begin, site.stop))


def clipped(site: Site) -> tuple[ImuBlock, Rows]:
    """Clip far below the range."""
    now, imu = slice(site.begin, site.stop), site.walk.imu
    gyro_radps, accel_mps2 = site.rng.uniform(*RANGES.clipped_radps), site.rng.uniform(*RANGES.clipped_mps2)
    gyro = np.clip(imu.gyro_radps[now], -gyro_radps, gyro_radps)
    return with_these(site, now, gyro, np.clip(imu.accel_mps2[now], -accel_mps2, accel_mps2))


def kicked(site: Site) -> tuple[ImuBlock, Rows]:
    """Turn the sensor on the foot, between two samples."""
    axis = site.rng.standard_normal(3)
    turned = Rotation.from_rotvec(site.drawn.amount * axis / np.linalg.norm(axis))
    after, later = slice(site.begin, None), sensed_walk(site.drawn, turned).imu
    return with_these(site, after, later.gyro_radps[after], later.accel_mps2[after])


def fallen(site: Site) -> tuple[ImuBlock, Rows]:
    """Tumble, at random but smoothly."""
    sensor, now = site.drawn.sensor, slice(site.begin, site.stop)
    knot_s = KNOT_S * np.arange(np.ceil(site.drawn.amount / KNOT_S) + 1.0)
    time_s = np.arange(site.stop - site.begin) / site.drawn.rate_hz
    felt = Curve(knot_s, site.rng.standard_normal((len(knot_s), 6))).at(time_s)[0]
    gyro, accel = RANGES.fall_radps * felt[:, :3], RANGES.fall_mps2 * felt[:, 3:]
    gyro = np.clip(gyro, -sensor.gyro_range_radps, sensor.gyro_range_radps)
    return with_these(site, now, gyro, np.clip(accel, -sensor.accel_range_mps2, sensor.accel_range_mps2))


def with_these(site: Site, now: slice, gyro_radps: Floats, accel_mps2: Floats) -> tuple[ImuBlock, Rows]:
    """Return the samples with other values in some rows."""
    imu, rows = untouched(site)
    gyro, accel = imu.gyro_radps.copy(), imu.accel_mps2.copy()
    gyro[now], accel[now] = gyro_radps, accel_mps2
    return imu._replace(gyro_radps=gyro, accel_mps2=accel), rows


def jittered(site: Site) -> tuple[ImuBlock, Rows]:
    """Move every stamp."""
    imu, rows = untouched(site)
    off_s = site.rng.uniform(-1.0, 1.0, len(rows)) * site.drawn.amount / site.drawn.rate_hz
    return imu._replace(stamp_ns=imu.stamp_ns + np.rint(NANOSECONDS * off_s).astype(np.int64)), rows


def lossy(site: Site) -> tuple[ImuBlock, Rows]:
    """Lose single samples."""
    imu, rows = untouched(site)
    return imu, rows[site.rng.random(len(rows)) >= site.drawn.amount]


AFFECTED: dict[str, Callable[[Site], tuple[ImuBlock, Rows]]] = {
    NO_TROUBLE.name: untouched,
    "gap": interrupted,
    "clipped": clipped,
    "kicked": kicked,
    "fall": fallen,
    "jitter": jittered,
    "lost": lossy,
}
