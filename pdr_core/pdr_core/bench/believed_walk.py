"""Walks that are exactly what the filter believes: its noise, its biases, and feet that stand as still as it thinks.

In stance the foot trembles: its velocity at each sample is white with the filter's `zero_velocity_sd_mps`. The foot is
where this velocity leads by the trapezium, so means over the intervals (`simulation/increments.py`) hold it exactly,
and the true velocity of a stance is the noise of its zero-velocity update, independent of every error of the estimate.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, gravity_mps2, stamp_ns_from_seconds
from pdr_core.params import FilterParams, Params, PlaceParams, changed
from pdr_core.records import Floats, ImuBlock, Stamps, inertial_block
from pdr_core.simulation.courses import gui_rectangle
from pdr_core.simulation.gui_motion import GuiCourse, Phase
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.simulation.increments import interval_means
from pdr_core.simulation.motion import Motion

RATE_HZ = 100.0
START_S, END_S = 10.0, 3.0  # standing; the first rest gives the gyro bias, and with it the heading of the whole walk
CONSUMER = SENSOR_MODELS["consumer"]


class Ground(NamedTuple):
    """What all walks share: when, and how the foot would move if it stood still in stance."""

    stamp_ns: Stamps  # (n,)
    motion: Motion


class BelievedWalk(NamedTuple):
    """One walk: where the foot was, how fast, and what its sensor gave."""

    position_m: Floats  # (n, 3)
    velocity_mps: Floats  # (n, 3)
    imu: ImuBlock


def told() -> Params:
    """Return the parameters of a suite that knows it all.

    A consumer-grade sensor that integrates, white noise, gravity, and feet that tremble but do not roll.
    """
    densities = {name: getattr(CONSUMER, name) for name in ("gyro_noise_density", "accel_noise_density")}
    white = changed(Params(), "intake", change_noise=0.0, **densities)
    return changed(
        white, "filter", samples="means", gravity_source="place", contact_height_m=0.0, huber=white.filter.gate
    )


def ground(length_m: float, rest_s: float = START_S) -> Ground:
    """Return a walk round a rectangle, in whole steps, of about `length_m`, after a rest.

    With corners, as people walk: straight ahead no walk tells an accelerometer bias from a tilt, so that all epochs
    would share one error, and a hundred walks would be lucky or not together.
    """
    phases = [Phase(rest_s), *gui_rectangle(length_m), Phase(END_S)]
    course = GuiCourse(phases)
    time_s = np.arange(round(course.duration_s * RATE_HZ)) / RATE_HZ
    return Ground(stamp_ns_from_seconds(time_s), course.at(time_s))


def believed_walk(where: Ground, believed: FilterParams, trembles: bool, seed: int) -> BelievedWalk:
    """Draw a walk: tremble, biases and their drift, sensor noise."""
    rng, n = np.random.default_rng(seed), len(where.stamp_ns)
    velocity_mps = where.motion.velocity_mps.copy()
    tremble = rng.normal(0.0, believed.zero_velocity_sd_mps, (n, 3))
    velocity_mps[where.motion.stance] += trembles * tremble[where.motion.stance]
    dt_s = np.diff(where.stamp_ns)[:, None] / NANOSECONDS
    moved_m = np.cumsum(0.5 * (velocity_mps[:-1] + velocity_mps[1:]) * dt_s, axis=0)
    position_m = np.concatenate([np.zeros((1, 3)), moved_m])
    gravity = gravity_mps2(np.radians(PlaceParams().latitude_deg))
    gyro, accel = interval_means(where.stamp_ns, position_m, velocity_mps, where.motion.quat_xyzw, gravity)
    gyro += drawn(rng, n, believed.initial_gyro_bias_sd_radps, believed.gyro_bias_walk, CONSUMER.gyro_noise_density)
    accel += drawn(rng, n, believed.initial_accel_bias_sd_mps2, believed.accel_bias_walk, CONSUMER.accel_noise_density)
    return BelievedWalk(position_m, velocity_mps, inertial_block(where.stamp_ns, gyro, accel, np.zeros(n), np.zeros(n)))


def drawn(rng: np.random.Generator, n: int, bias_sd: float, walk: float, density: float) -> Floats:
    """Return what a sensor adds to the truth, (n, 3): bias, its random walk, white noise."""
    bias = rng.normal(0.0, bias_sd, 3)
    drift = np.cumsum(rng.normal(0.0, walk / np.sqrt(RATE_HZ), (n, 3)), axis=0)
    return bias + drift + rng.normal(0.0, density * np.sqrt(RATE_HZ), (n, 3))
