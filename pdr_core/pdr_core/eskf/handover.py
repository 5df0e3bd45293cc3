"""From the filter's memory to what another estimator can go on from, and back."""

import numpy as np

from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, POSITION, SIZE
from pdr_core.eskf.state import FilterState
from pdr_core.records import Biases, Floats, Handover, PoseEstimate

POSE = [*range(POSITION, POSITION + 3), *range(ATTITUDE, ATTITUDE + 3)]
BIASES = [*range(ACCEL_BIAS, SIZE)]


def handed_over(state: FilterState) -> Handover:
    """Return the filter's estimate of now."""
    pose = PoseEstimate(state.position_m.copy(), state.quat_xyzw.copy(), state.P[np.ix_(POSE, POSE)])
    biases = Biases(state.accel_bias_mps2.copy(), state.gyro_bias_radps.copy(), state.P[np.ix_(BIASES, BIASES)])
    return Handover(int(state.last_ns), pose, biases)


def initial_deviations(start: Handover, usual_sd: Floats) -> Floats:
    """Return the deviations (15,) of a filter that is levelled at `start`; what is not known there is as usual."""
    sd = usual_sd.copy()
    sd[POSITION : POSITION + 3] = np.sqrt(np.diag(start.pose.covariance)[:3])
    sd[ATTITUDE + 2] = np.sqrt(start.pose.covariance[5, 5])
    if start.biases:
        sd[BIASES] = np.sqrt(np.diag(start.biases.covariance))
    return sd
