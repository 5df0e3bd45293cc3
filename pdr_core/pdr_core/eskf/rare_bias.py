"""A gyro bias far beyond what sensors usually bring is believed where two witnesses agree: the rest and the field.

A foot that turns slowly while it seems to rest shows a bias that is not there. So the filter starts from what sensors
usually bring, .2 deg/s, and takes a rest that says more with reserve. But there are sensors with 1 deg/s. The magnetic
field, where it is measured, saw the same rest; where it speaks for the same bias, the prior of an axis that lies more
than RARE deviations off is widened to what the rest has shown. (Measured with the rest alone as a witness: tile walks
with 1 deg/s more on the z axis .53 -> .21 m mean error, but the 28 walks of the motion capture room .055 -> .069 m.)

From then on stances may correct the bias too, which they are not let do otherwise (see `zupt.py`): a bias that large
is known by no more than that one rest.
"""

import numpy as np

from pdr_core.eskf.error_state import GYRO_BIAS
from pdr_core.eskf.quiet_field import QuietField
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Vector, cross, difference, dot, norm, scaled
from pdr_core.records import Floats

RARE = 3.0
AGREE = 3.4  # deviations: chi-square, 3 degrees of freedom, 99 %


@compiled
def testify(field: QuietField, change_sd: float, state: FilterState) -> None:
    """Note what a window of the field says of the bias: b_est + m x change / m'm, short of what lies along m."""
    m = field.mean_tesla
    shown = scaled(1.0 / dot(m, m), cross(m, field.change_tesla_per_s))
    state.witness_sd = change_sd
    state.witness_tesla[:] = m
    for i in range(3):
        state.witness_bias_radps[i] = state.gyro_bias_radps[i] + shown[i]


@compiled
def weigh(rest_rate_radps: Vector, rest_sd_radps: float, usual_sd: Floats, state: FilterState) -> None:
    """Prepare the filter for the bias of a rest; `usual_sd` (15,) are the deviations of the start."""
    if agrees(rest_rate_radps, rest_sd_radps, state):
        widen(rest_rate_radps, rest_sd_radps, usual_sd, state)


@compiled
def agrees(rest_rate_radps: Vector, rest_sd_radps: float, state: FilterState) -> bool:
    """Return whether the last window of the field speaks for the bias that a rest has shown."""
    if state.witness_sd == 0.0:
        return False
    m = state.witness_tesla
    missed = cross(difference(rest_rate_radps, state.witness_bias_radps), m)
    return norm(missed) < AGREE * np.hypot(state.witness_sd, rest_sd_radps * norm(m))


@compiled
def widen(rest_rate_radps: Vector, rest_sd_radps: float, usual_sd: Floats, state: FilterState) -> None:
    """Widen the variance of each axis on which the rest shows a rare bias."""
    for i in range(GYRO_BIAS, GYRO_BIAS + 3):
        shown = rest_rate_radps[i - GYRO_BIAS] ** 2 - rest_sd_radps**2
        if shown > (RARE * usual_sd[i]) ** 2:
            state.bias_is_rare = True
            state.P[i, i] = max(shown, state.P[i, i])
