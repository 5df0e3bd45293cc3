"""The first moments of the filter: the foot rests at the origin and gravity gives its attitude."""

import numpy as np

from pdr_core.eskf.levelling import levelled
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import norm
from pdr_core.records import Floats

PLAUSIBLE_GRAVITY = 0.03  # where the specific force of the rest differs by more, gravity is taken from the place
MOVING_RADPS = 0.5


@compiled
def align(stamp_ns: int, force_mps2: Floats, rate_radps: Floats, s: Settings, state: FilterState) -> None:
    """Take one sample into the mean specific force and level the foot by it."""
    a = state.alignment
    if a.start_ns[0] < 0:
        a.start_ns[0] = stamp_ns
        state.P[:] = np.diag(s.initial_sd**2)
    a.force_sum[:] += force_mps2
    a.samples[0] += 1
    a.moving[0] = a.moving[0] or norm(rate_radps) > MOVING_RADPS
    mean = a.force_sum / a.samples[0]
    state.nominal.quat_xyzw[:] = levelled(mean, s.initial_yaw_rad)
    plausible = abs(norm(mean) / s.gravity_mps2 - 1.0) < PLAUSIBLE_GRAVITY
    state.gravity_mps2[0] = norm(mean) if s.gravity_from_rest and plausible else s.gravity_mps2
    state.last_accepted_ns[0] = stamp_ns
    a.running[0] = stamp_ns - a.start_ns[0] < s.alignment_ns
