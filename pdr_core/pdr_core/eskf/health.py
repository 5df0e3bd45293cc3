"""How far the filter can be trusted, in words and in numbers."""

import numpy as np

from pdr_core.eskf import initial_yaw
from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, GYRO_BIAS, POSITION, VELOCITY
from pdr_core.eskf.field_heading import known
from pdr_core.eskf.state import FilterState
from pdr_core.records import FieldUse, FilterHealth, FilterMode, Level, Notice

LOST_AFTER_S = 5.0  # no step takes so long
WHY_LOST = "is the sensor fixed to the shoe? Worn on the chest it needs `--pipeline chest`; on the shoe,"
WHICH_FINDS = "`pdr compare --detectors all` shows which detector finds its stances"
FIELD_USED = {
    FieldUse.CHANGE: "the magnetic field shows the gyro bias; a compass it is where many places in a row agree",
    FieldUse.HEADING: "the magnetic field is clean: it shows the gyro bias and the heading",
}
NO_COMPASS = {
    initial_yaw.MOVED: "the foot moved in the first second",
    initial_yaw.TOO_FEW: "the first second has fewer than three fields",
    initial_yaw.UNSTEADY: "the field is not steady while the foot rests",
    initial_yaw.STEEP: "the field is too steep here",
    initial_yaw.NOT_EARTHS: "the field is not as strong as the Earth's: not calibrated, or iron is near",
    initial_yaw.NOT_PLACES: "the field differs from place.field_norm_tesla and field_dip_deg: iron is near",
}


def notices(state: FilterState) -> list[Notice]:
    """Return what a person should know of the filter."""
    start_ns, swing_s = int(state.alignment_start_ns), float(state.longest_swing_s)
    doubted, gaps = int(state.doubted), int(state.gaps)
    found = []
    if state.moved:
        text = "the foot moved while it was levelled: stand still for the first moments"
        found.append(Notice(Level.WARN, "moving_start", text, 1, start_ns))
    if doubted:
        text = "stances contradicted the estimate until it gave way: the track was off before them"
        found.append(Notice(Level.WARN, "estimate_doubted", text, doubted, start_ns))
    if swing_s > LOST_AFTER_S:
        text = f"no stance for {swing_s:.0f} s: the track is lost; {WHY_LOST} {WHICH_FINDS}"
        found.append(Notice(Level.ERROR, "no_stance", text, 1, start_ns))
    if gaps:
        text = "intervals were not navigated: the position was held across them"
        found.append(Notice(Level.WARN, "coasted", text, gaps, start_ns))
    if state.compass != initial_yaw.UNDECIDED:
        found.append(compass_notice(state))
    if state.field_use:
        found.append(Notice(Level.OK, "field_use", FIELD_USED[FieldUse(int(state.field_use))], 1, start_ns))
    if state.field_rejected > state.field_windows:
        text = "most stances contradict the magnetic field: is the magnetometer calibrated (`pdr calibrate mag`)?"
        found.append(Notice(Level.WARN, "field_contradicts", text, int(state.field_rejected), start_ns))
    return found


def compass_notice(state: FilterState) -> Notice:
    """Return whether the field has given the yaw at the start, and why not."""
    start_ns, why = int(state.alignment_start_ns), NO_COMPASS.get(int(state.compass))
    if why:
        text = f"the yaw at the start is the given one, not the magnetometer's: {why}"
        return Notice(Level.WARN, "initial_yaw_given", text, 1, start_ns)
    yaw_deg, sd_deg = np.degrees([state.compass_yaw_rad, state.compass_yaw_sd_rad])
    text = f"the yaw at the start is the magnetometer's: {yaw_deg:+.1f} deg from east, good to {sd_deg:.0f} deg"
    return Notice(Level.OK, "initial_yaw", text, 1, start_ns)


def judged(state: FilterState, resets: int) -> FilterHealth:
    """Return the filter's state in numbers."""
    P = state.P
    sd = np.sqrt(np.diag(P))
    since_s = float(state.last_ns - state.last_accepted_ns) * 1e-9
    return FilterHealth(
        mode=mode(state),
        stamp_ns=int(state.last_ns),
        quality=quality(state, since_s),
        samples=int(state.samples),
        accepted=int(state.accepted),
        contradicted=int(state.contradicted),
        gaps=int(state.gaps),
        resets=resets,
        since_zero_velocity_s=since_s,
        normalised_innovation=float(state.normalised_innovation),
        position_sd_m=float(np.sqrt(np.linalg.eigvalsh(P[POSITION : POSITION + 2, POSITION : POSITION + 2])[-1])),
        height_sd_m=float(sd[POSITION + 2]),
        velocity_sd_mps=float(sd[VELOCITY : VELOCITY + 3].max()),
        tilt_sd_rad=float(sd[ATTITUDE : ATTITUDE + 2].max()),
        yaw_sd_rad=float(sd[ATTITUDE + 2]),
        gyro_bias_radps=state.gyro_bias_radps.copy(),
        gyro_bias_sd_radps=sd[GYRO_BIAS : GYRO_BIAS + 3],
        accel_bias_mps2=state.accel_bias_mps2.copy(),
        accel_bias_sd_mps2=sd[ACCEL_BIAS : ACCEL_BIAS + 3],
        gravity_mps2=float(state.gravity_mps2),
        field_use=FieldUse(int(state.field_use)),
        north_rad=float(state.north_rad),
        north_sd_rad=min(np.pi, float(np.sqrt(state.north_variance))) if known(state) else np.pi,
    )


def mode(state: FilterState) -> FilterMode:
    """Return what the filter is doing."""
    if state.aligning:
        return FilterMode.ALIGNING
    return FilterMode.COASTING if state.coasting else FilterMode.NAVIGATING


def quality(state: FilterState, since_zero_velocity_s: float) -> float:
    """Return the share of stances that agreed with the estimate, fading to 0 while no stance is found."""
    share = state.accepted / max(1, state.accepted + state.contradicted)
    return float(share * max(0.0, 1.0 - since_zero_velocity_s / LOST_AFTER_S))
