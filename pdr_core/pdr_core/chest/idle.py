"""Who moves and makes no step: stands and works, sits, or goes so gently that nothing tells it.

A speed that is integrated without rest and step is bounded by nothing. So after a while it is taken for none, and the
position is held, until there is a whole step again. What tilt has gathered meanwhile that walk's first strides take
back, as after a gap.
"""

from pdr_core.chest.recovery import GAP_SPEED_SD_MPS
from pdr_core.chest.state import ChestState
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled

IDLE_NS = 6_000_000_000  # who walks at 0.4 m/s may be seen to only then


@compiled
def watch(stamp_ns: int, ended: bool, state: ChestState) -> None:
    """Take whether a step has ended with a sample; hold who makes none, and let go who does."""
    if ended and state.idle:
        go_on(stamp_ns, state)
    jumped = state.stepped_ns == NO_STAMP or stamp_ns < state.stepped_ns
    if ended or state.resting or not state.aligned or jumped:
        state.stepped_ns = stamp_ns
        state.idle = False
    elif stamp_ns - state.stepped_ns > IDLE_NS and not state.idle:
        state.idle = True
        state.idled += 1
        state.held_m[:] = state.position_m


@compiled
def go_on(stamp_ns: int, state: ChestState) -> None:
    """Let her have walked since the step began that ends now, at a tilt that is not known."""
    state.even_m[:] = state.position_m
    state.even_ns = state.step_start_ns
    state.level_due, state.level_ns = True, stamp_ns


@compiled
def hold(state: ChestState) -> None:
    """Stay where it is, as fast as nobody knows."""
    state.position_m[:] = state.held_m
    state.velocity_mps[:] = 0.0
    state.velocity_sd_mps = GAP_SPEED_SD_MPS
