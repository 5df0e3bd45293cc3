"""Zhou's figure 9: the features of strides of a person who walks as usual, and who walks fast."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from pdr_core.bench.zhou_modes import simulation
from pdr_core.gait.accelerometer_steps import AccelerometerSteps
from pdr_core.params import GaitParams
from pdr_core.records import Floats
from pdr_core.simulation import simulated_walk

PACES = {"walking normally": 1.0, "walking fast": 1.6}  # at 1.6 times a tester's speed people are about to run
WALK_M = 100.0


class Features(NamedTuple):
    """The strides of one walk, (strides,)."""

    name: str
    frequency_hz: Floats
    mean_mps2: Floats  # of |a| beside gravity
    max_mps2: Floats


def features(tester: str) -> list[Features]:
    """Return both walks."""
    return [walked(name, pace, tester) for name, pace in PACES.items()]


def walked(name: str, pace: float, tester: str) -> Features:
    """Return the strides of a straight walk."""
    params = simulation("straight", WALK_M, tester, 1)
    imu = simulated_walk(replace(params, pace=pace)).imu
    steps = AccelerometerSteps(GaitParams()).run(imu).steps
    rows = [(s.frequency_hz, s.accel_mean_abs_mps2, s.accel_max_mps2) for s in steps]
    return Features(name, *np.array(rows).T)
