"""Compiles everything once, so that the first run of a user is fast: `python -m pdr_core.warmup`."""

import numpy as np

from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.records import ImuBlock

DEFAULTS = Params()


def warm_up(params: Params = DEFAULTS) -> None:
    """Run the pipeline over one sample: every function that it needs is compiled, or loaded from the cache."""
    one, gravity = np.zeros(1), np.array([[0.0, 0.0, 9.81]])
    pipeline = FootInertial(params)
    pipeline.run(ImuBlock(np.zeros(1, np.int64), np.zeros((1, 3)), gravity, one, one))
    pipeline.finish()


if __name__ == "__main__":
    warm_up()
