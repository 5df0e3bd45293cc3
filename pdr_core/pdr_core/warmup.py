"""Compiles everything once, so that the first run of a user is fast: `python -m pdr_core.warmup`."""

from dataclasses import replace

import numpy as np

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import BothFeet, FootAdaptive, FootGait, FootInertial, OrientedIntake, SmoothedFoot
from pdr_core.pipeline.reckon_once import reckon_once
from pdr_core.records import ImuBlock, StepEvent
from pdr_core.simulation import simulated_walk

DEFAULTS = Params()
FEET = ("left", "right")
STEP = StepEvent(1, 0, 5_000_000, np.zeros(3), np.zeros(3), np.eye(3), 0.0, 0.0, sample_numbers=(0, 1))


def warm_up(params: Params = DEFAULTS, smooth: bool = False, both: bool = False, adaptive: bool = False) -> None:
    """Run the pipeline over two samples: every function that it needs is compiled, or loaded from the cache.

    The smoother, which does not run live, the fusion of both feet and what navigates without the gyro are warmed up
    where they are asked for.
    """
    noise, gravity = np.zeros(2), np.tile([0.0, 0.0, 9.81], (2, 1))
    zero = np.zeros((2, 3))
    samples = ImuBlock(np.array([0, 5_000_000]), zero, gravity, noise, noise, zero, noise)
    pipeline, gait = FootInertial(params), FootGait()
    gait.run(pipeline.run(samples))
    gait.run(replace(pipeline.finish(), steps=[STEP]))
    gait.finish()
    oriented = OrientedIntake(params)
    oriented.run(samples)
    oriented.finish()
    if both:
        feet = BothFeet(params, FEET)
        for foot in FEET:
            feet.run(foot, samples)
        feet.finish()
    if adaptive:
        switched = FootAdaptive(params)
        switched.run(samples)
        switched.finish()
        reckon_once(params)
    if smooth:
        smoothed = SmoothedFoot(params)
        smoothed.run(samples)
        list(smoothed.finish())


def walk_without_gyro() -> FootAdaptive:
    """Walk until strides are reckoned and the filter is back in a clean field: two samples do not get there."""
    walk = SimulationParams(motion="smooth", walk="rectangle", walk_length_m=50.0, magnetometer=True)
    switched = FootAdaptive(changed(DEFAULTS, "power", calibration_m=20.0))
    switched.run(simulated_walk(walk).imu)
    switched.finish()
    return switched


if __name__ == "__main__":
    warm_up(smooth=True, both=True, adaptive=True)
    walk_without_gyro()
