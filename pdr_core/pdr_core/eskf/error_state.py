"""The 15 errors of the filter, and the nominal state that they correct.

An error is the truth minus the estimate. The attitude error is a small rotation in the world frame:
R_true = Exp(attitude error) R_estimated. A bias is what the sensor shows too much: measured = true + bias. These
definitions fix every sign in `process.py` and in the updates; Gui eq. 13-14 and Zhou eq. 7 define some of them the
other way round.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import from_rotation_vector, multiply, normalised
from pdr_core.records import Floats

SIZE = 15
POSITION, VELOCITY, ATTITUDE, ACCEL_BIAS, GYRO_BIAS = 0, 3, 6, 9, 12  # where each error's three axes begin


class Nominal(NamedTuple):
    """The estimate, corrected in place."""

    position_m: Floats  # (3,)
    velocity_mps: Floats  # (3,) in the world frame
    quat_xyzw: Floats  # (4,) world from foot
    accel_bias_mps2: Floats  # (3,)
    gyro_bias_radps: Floats  # (3,)


def at_origin() -> Nominal:
    """Return a foot that stands at the origin and faces along x."""
    return Nominal(np.zeros(3), np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), np.zeros(3), np.zeros(3))


def observing(error: int) -> Floats:
    """Return the Jacobian H, (3, 15), of a measurement that shows one error directly."""
    return np.eye(SIZE)[error : error + 3]


@compiled
def inject(nominal: Nominal, error: Floats) -> None:
    """Correct the estimate by the estimated errors (15,), which are zero thereafter."""
    nominal.position_m[:] += error[POSITION : POSITION + 3]
    nominal.velocity_mps[:] += error[VELOCITY : VELOCITY + 3]
    turn = from_rotation_vector(error[ATTITUDE : ATTITUDE + 3])
    nominal.quat_xyzw[:] = normalised(multiply(turn, nominal.quat_xyzw))
    nominal.accel_bias_mps2[:] += error[ACCEL_BIAS : ACCEL_BIAS + 3]
    nominal.gyro_bias_radps[:] += error[GYRO_BIAS : GYRO_BIAS + 3]
