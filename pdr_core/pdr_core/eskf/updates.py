"""The measurement updates: gate, gain, correction of estimate and covariance (Gui eq. 20-26, Zhou eq. 10-13)."""

import numpy as np

from pdr_core.eskf import zaru, zupt
from pdr_core.eskf.error_state import SIZE, inject
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import correct, gain, innovation_covariance, normalised_innovation_squared
from pdr_core.maths.vector import product
from pdr_core.records import Floats

zupt_residual, zupt_jacobian, zupt_gain = zupt.residual, zupt.jacobian, zupt.without_gyro_bias
zaru_residual, zaru_jacobian = zaru.residual, zaru.jacobian


@compiled
def apply(residual: Floats, H: Floats, R: Floats, K: Floats, state: FilterState) -> None:
    """Correct the estimate, its covariance and its covariance with the ends of the last stances."""
    inject(state.nominal, product(K, residual.reshape(-1, 1))[:, 0])
    state.ends.cross[:] -= product(K, product(H, state.ends.cross))
    correct(state.P, K, H, R)


@compiled
def zero_velocity(stamp_ns: int, s: Settings, state: FilterState) -> bool:
    """Tell the filter that the foot stands; return whether it believed it.

    An innovation beyond the gate is rejected: a false stance would stop a swinging foot. But where the rejections of
    one stance go on for longer than the release time, it is the estimate that is wrong, and the update is taken with
    a noise that brings it to the gate. So nothing locks the filter out.
    """
    H = zupt_jacobian()
    R = np.eye(3) * s.zero_velocity_sd_mps**2
    residual = zupt_residual(state.nominal.velocity_mps)
    S = innovation_covariance(state.P, H, R)
    d2 = normalised_innovation_squared(residual, S)
    state.counts.normalised_innovation[0] = d2
    if d2 > s.gate:
        if state.rejecting_since_ns[0] < 0:
            state.rejecting_since_ns[0] = stamp_ns
        if stamp_ns - state.rejecting_since_ns[0] < s.release_ns:
            state.counts.rejected[0] += 1
            return False
        R += (d2 / s.gate - 1.0) * S
        S = S * (d2 / s.gate)
        state.counts.released[0] += 1
    else:
        state.rejecting_since_ns[0] = -1
    apply(residual, H, R, zupt_gain(gain(state.P, H, S)), state)
    state.last_accepted_ns[0] = stamp_ns
    state.counts.accepted[0] += 1
    return True


@compiled
def zero_rate(rest_rate_radps: Floats, rest_sd_radps: float, state: FilterState) -> None:
    """Tell the filter the gyro bias that a rest has shown."""
    H = zaru_jacobian()
    R = np.eye(3) * rest_sd_radps**2
    S = innovation_covariance(state.P, H, R)
    residual = zaru_residual(rest_rate_radps, state.nominal.gyro_bias_radps)
    apply(residual, H, R, gain(state.P, H, S), state)
