"""The first moments of the filter: the foot rests at the origin, gravity levels it, and the field may give its yaw."""

import numpy as np

from pdr_core.eskf.initial_yaw import WATCHED_NS
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.levelling import levelled
from pdr_core.maths.vector import Vector, norm

PLAUSIBLE_GRAVITY = 0.03  # where the specific force of the rest differs by more, gravity is taken from the place
MOVING_RADPS = 0.5


@compiled
def align(stamp_ns: int, force_mps2: Vector, rate_radps: Vector, s: Settings, state: FilterState) -> None:
    """Take one sample into the mean specific force, without the known bias, and level the foot by it."""
    if state.force_samples == 0:
        state.P[:] = np.diag(s.initial_sd**2)
    if state.force_samples == 0 or stamp_ns < state.alignment_start_ns:
        state.alignment_start_ns = stamp_ns
    state.force_sum_mps2[:] += np.array(force_mps2)
    state.force_samples += 1
    state.moved = state.moved or norm(rate_radps) > MOVING_RADPS
    mean = state.force_sum_mps2 / state.force_samples - state.accel_bias_mps2
    state.quat_xyzw[:] = levelled(mean, s.initial_yaw_rad)
    plausible = abs(norm(mean) / s.gravity_mps2 - 1.0) < PLAUSIBLE_GRAVITY
    state.gravity_mps2 = norm(mean) if s.gravity_from_rest and plausible else s.gravity_mps2
    state.last_accepted_ns = stamp_ns
    watched_ns = WATCHED_NS if s.compass_start and not state.moved else 0
    state.aligning = stamp_ns - state.alignment_start_ns < max(s.alignment_ns, watched_ns)
