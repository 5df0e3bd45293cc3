"""Compiles everything once, so that the first run of a user is fast: `python -m pdr_core.warmup`."""

import numpy as np

from pdr_core.params import Params
from pdr_core.pipeline import FootInertial, SmoothedFoot
from pdr_core.records import ImuBlock

DEFAULTS = Params()


def warm_up(params: Params = DEFAULTS, smooth: bool = False) -> None:
    """Run the pipeline over one sample: every function that it needs is compiled, or loaded from the cache.

    The smoother, which does not run live, is warmed up where it is asked for.
    """
    one, gravity = np.zeros(1), np.array([[0.0, 0.0, 9.81]])
    zero = np.zeros((1, 3))
    sample = ImuBlock(np.zeros(1, np.int64), zero, gravity, one, one, zero, one)
    pipeline = FootInertial(params)
    pipeline.run(sample)
    pipeline.finish()
    if smooth:
        smoothed = SmoothedFoot(params)
        smoothed.run(sample)
        list(smoothed.finish())


if __name__ == "__main__":
    warm_up(smooth=True)
