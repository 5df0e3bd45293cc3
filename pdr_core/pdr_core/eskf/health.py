"""How far the filter can be trusted, in words and in one number."""

from pdr_core.eskf.state import FilterState
from pdr_core.records import Level, Notice


LOST_AFTER_S = 5.0  # no step takes so long


def notices(state: FilterState) -> list[Notice]:
    """Return what a person should know of the filter."""
    counts, start_ns = state.counts, int(state.alignment.start_ns[0])
    found = []
    if state.alignment.moving[0]:
        text = "the foot moved while it was levelled: stand still for the first moments"
        found.append(Notice(Level.WARN, "moving_start", text, 1, start_ns))
    if counts.released[0]:
        text = "zero-velocity updates far from the estimate were taken after all: the track was off before them"
        found.append(Notice(Level.WARN, "gate_released", text, int(counts.released[0]), start_ns))
    if counts.longest_swing_s[0] > LOST_AFTER_S:
        text = f"no stance for {counts.longest_swing_s[0]:.0f} s: the track is lost; is the sensor fixed to the shoe?"
        found.append(Notice(Level.ERROR, "no_stance", text, 1, start_ns))
    if counts.gaps[0]:
        text = "intervals were crossed without navigation: the position was held"
        found.append(Notice(Level.WARN, "coasted", text, int(counts.gaps[0]), start_ns))
    return found
