"""Steps from the acceleration alone: they cut the walk into the windows of eq. 10.

The body is pushed up at each footfall, so |f| - g, which needs no attitude, swings once a step. Behind a low-pass of
two poles a step ends where it rises through zero after it was low enough: a quarter of a step before the push, and
about as much later by the delay of the low-pass. Where in the step that is does not matter, as long as it is always
the same.

But a body sways from side to side, and its trunk twists, once in two steps: over one step the mean force to the side
is +-4 sway / T^2, 0.5 m/s^2. So what eq. 10 takes the mean of is a stride, the step that ends and the one before it.
"""

import numpy as np

from pdr_core.chest.ahead import chest_yaw_rad
from pdr_core.chest.settings import Settings
from pdr_core.chest.state import ChestState
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, Vector, added

SAMPLES, SUM, LARGEST, LEAST, MAGNITUDES = range(5)


@compiled
def rises(weight_mps2: float, dt_s: float, s: Settings, state: ChestState) -> bool:
    """Take |f| - g after an interval into the low-pass; return whether a step may end here."""
    keep = np.exp(-s.lowpass_radps * dt_s)
    before = state.low_mps2[1]
    for pole in range(2):
        state.low_mps2[pole] += (1.0 - keep) * (weight_mps2 - state.low_mps2[pole])
        weight_mps2 = state.low_mps2[pole]
    state.armed = state.armed or weight_mps2 < -s.swing_mps2
    return state.armed and before < 0.0 <= weight_mps2


@compiled
def long_enough(stamp_ns: int, s: Settings, state: ChestState) -> bool:
    """Return whether what began with the last step can be a whole one."""
    return stamp_ns - state.step_start_ns >= s.step_min_ns


@compiled
def too_long(stamp_ns: int, s: Settings, state: ChestState) -> bool:
    """Return whether no step takes so long."""
    return state.step_start_ns != NO_STAMP and stamp_ns - state.step_start_ns > s.step_max_ns


@compiled
def begin_step(stamp_ns: int, state: ChestState) -> None:
    """Begin the window of a step here."""
    state.armed = False
    state.step_start_ns = stamp_ns
    state.step_start_m[:] = state.position_m
    state.step_start_sd_m = state.position_sd_m
    state.step_force[:] = 0.0
    state.step_s = 0.0
    state.step_figures[:] = 0.0
    state.step_figures[LARGEST], state.step_figures[LEAST] = -1e9, 1e9
    state.step_yaw[:] = 0.0
    state.yaw_from_rad[1] = chest_yaw_rad(state.quat_xyzw, state)


@compiled
def hand_on(state: ChestState) -> None:
    """Keep the sums of the step that ends as those of the step before; not where they are of a tilt that was wrong."""
    state.force_before[:] = state.step_force
    state.yaw_before[:] = state.step_yaw
    state.yaw_from_rad[0] = state.yaw_from_rad[1]
    state.s_before = 0.0 if state.releveled else state.step_s
    state.releveled = False


@compiled
def forget_before(state: ChestState) -> None:
    """Keep nothing of the step before: there is none, or it is another walk's."""
    state.force_before[:] = 0.0
    state.yaw_before[:] = 0.0
    state.s_before = 0.0


@compiled
def gather(force_world_mps2: Vector, weight_mps2: float, yaw_rad: float, dt_s: float, state: ChestState) -> None:
    """Take an interval into the sums of the step."""
    for i in range(3):
        state.step_force[i] += force_world_mps2[i] * dt_s
    state.step_s += dt_s
    f = state.step_figures
    f[SAMPLES] += 1.0
    f[SUM] += weight_mps2
    f[LARGEST], f[LEAST] = max(f[LARGEST], weight_mps2), min(f[LEAST], weight_mps2)
    f[MAGNITUDES] += abs(weight_mps2)
    state.step_yaw[0] += np.cos(yaw_rad) * dt_s
    state.step_yaw[1] += np.sin(yaw_rad) * dt_s


@compiled
def step_ends(stamp_ns: int, weight_mps2: float, dt_s: float, s: Settings, state: ChestState) -> bool:
    """Return whether a whole step ends here; a first rise after a rest, a gap or a pause only begins one."""
    rose = rises(weight_mps2, dt_s, s, state)
    if state.resting or not state.aligned:
        state.moved = state.moved or (rose and not state.aligned)
        return False
    if too_long(stamp_ns, s, state):
        state.step_start_ns = NO_STAMP
        state.since_rest = 0
        state.walking = False
    if not rose:
        return False
    if state.step_start_ns == NO_STAMP:
        forget_before(state)
        begin_step(stamp_ns, state)
        state.since_rest += 1
        return False
    return long_enough(stamp_ns, s, state)


@compiled
def stride_force(state: ChestState) -> Triple:
    """Return the integral of the force over the step that ends and the one before, in the world frame [m/s].

    Without what turns a walk: who walks a bend keeps her velocity beside the chest, and the force turns it with her.
    """
    x, y, z = added(state.force_before, state.step_force)
    before_rad, now_rad = state.yaw_from_rad[0], chest_yaw_rad(state.quat_xyzw, state)
    c, n = np.cos(now_rad) - np.cos(before_rad), np.sin(now_rad) - np.sin(before_rad)
    ahead, left = state.walk_mps
    return x - (c * ahead - n * left), y - (n * ahead + c * left), z
