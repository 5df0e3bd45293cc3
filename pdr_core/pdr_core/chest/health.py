"""How far the chest's estimate can be trusted, in words and in numbers."""

import numpy as np

from pdr_core.chest.output import tilt_sd_rad
from pdr_core.chest.settings import Settings
from pdr_core.chest.state import UNKNOWN_M, ChestState
from pdr_core.records import FieldUse, FilterHealth, FilterMode, Level, Notice


def notices(state: ChestState) -> list[Notice]:
    """Return what a person should know of the estimate."""
    start_ns, found = int(state.last_ns), []
    if not state.aligned:
        text = "no rest yet: stand still for three seconds, nothing is known of the attitude before"
        found.append(Notice(Level.WARN if state.moved else Level.OK, "no_rest", text, 1, start_ns))
    if state.gaps:
        text = "samples were missing: the walk was taken to go on as before"
        found.append(Notice(Level.WARN, "coasted", text, int(state.gaps), start_ns))
    if state.idled:
        text = "it moved for seconds with neither rest nor step, and was taken to stay: below 0.4 m/s no steps are seen"
        found.append(Notice(Level.WARN, "no_steps", text, int(state.idled), start_ns))
    if state.levelled:
        text = "the tilt was off by more than a walk explains, and was found anew: is the card fixed to the chest?"
        found.append(Notice(Level.WARN, "levelled_anew", text, int(state.levelled), start_ns))
    return found


def judged(state: ChestState, s: Settings) -> FilterHealth:
    """Return the estimate's state in numbers; its zero-velocity updates are the rests."""
    return FilterHealth(
        mode=mode(state),
        stamp_ns=int(state.last_ns),
        quality=max(0.0, 1.0 - float(state.position_sd_m) / UNKNOWN_M) if state.aligned else 0.0,
        samples=int(state.samples),
        accepted=int(state.rests),
        contradicted=int(state.levelled),
        gaps=int(state.gaps),
        resets=int(state.placed),
        since_zero_velocity_s=since_rest_s(state),
        normalised_innovation=0.0,
        position_sd_m=float(state.position_sd_m),
        height_sd_m=float(state.position_sd_m),
        velocity_sd_mps=float(state.velocity_sd_mps),
        tilt_sd_rad=tilt_sd_rad(s, state),
        yaw_sd_rad=float(state.yaw_sd_rad),
        gyro_bias_radps=state.gyro_bias_radps.copy(),
        gyro_bias_sd_radps=np.full(3, float(state.bias_variance) ** 0.5),
        accel_bias_mps2=np.zeros(3),
        accel_bias_sd_mps2=np.zeros(3),
        gravity_mps2=s.gravity_mps2,
        field_use=FieldUse.NONE,
        north_rad=0.0,
        north_sd_rad=np.pi,
    )


def mode(state: ChestState) -> FilterMode:
    """Return what the chest is doing."""
    if not state.aligned:
        return FilterMode.ALIGNING
    return FilterMode.COASTING if state.coasting else FilterMode.NAVIGATING


def since_rest_s(state: ChestState) -> float:
    """Return how long ago the last rest ended [s]."""
    if state.resting or not state.aligned:
        return 0.0
    return float(state.last_ns - state.rest_end_ns) * 1e-9
