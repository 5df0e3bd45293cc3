"""Compiles everything once, so that the first run of a user is fast: `python -m pdr_core.warmup`."""

from dataclasses import replace

import numpy as np

from pdr_core.params import Params
from pdr_core.pipeline import FootGait, FootInertial, OrientedIntake, SmoothedFoot
from pdr_core.records import ImuBlock, StepEvent

DEFAULTS = Params()
STEP = StepEvent(1, 0, 5_000_000, np.zeros(3), np.zeros(3), np.eye(3), 0.0, 0.0, sample_numbers=(0, 1))


def warm_up(params: Params = DEFAULTS, smooth: bool = False) -> None:
    """Run the pipeline over two samples: every function that it needs is compiled, or loaded from the cache.

    The smoother, which does not run live, is warmed up where it is asked for.
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
    if smooth:
        smoothed = SmoothedFoot(params)
        smoothed.run(samples)
        list(smoothed.finish())


if __name__ == "__main__":
    warm_up(smooth=True)
