"""What a stride shows of the tilt, and what is fed back of it (Cheng section 2.1, eq. 10-12)."""

from pdr_core.chest.correction import error, feed_back
from pdr_core.chest.recovery import find_anew, lost
from pdr_core.chest.settings import IMPROVED, Settings
from pdr_core.chest.state import ChestState
from pdr_core.chest.steps import stride_force
from pdr_core.maths.compiled import compiled


@compiled
def uniform(s: Settings, state: ChestState) -> bool:
    """Return whether the step that ends is one of uniform motion: behind the start, its mean force but weight."""
    if state.since_rest <= s.start_steps or state.s_before == 0.0:
        return False
    stride_s = state.s_before + state.step_s
    x, y, _ = stride_force(state)
    return x**2 + y**2 < (s.uniform_accel_mps2 * stride_s) ** 2


@compiled
def correct_attitude(stamp_ns: int, s: Settings, state: ChestState) -> bool:
    """Feed back what the step that ends has shown (eq. 10-12); return whether it was one of uniform motion."""
    even = uniform(s, state)
    state.uneven = 0 if even or state.since_rest <= s.start_steps else state.uneven + 1
    if s.method != IMPROVED:
        return even
    if lost(s, state):
        find_anew(stamp_ns, state)
        even = False
    elif even:
        feed_back(error(stride_force(state)), s.feedback_per_s, stamp_ns + s.step_max_ns, state)
        state.fed_back += 1
    else:
        state.feedback_radps[:] = 0.0
    return even
