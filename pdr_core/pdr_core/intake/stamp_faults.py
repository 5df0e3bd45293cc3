"""What can be wrong with a stamp, and how it is told: one kind, one notice."""

from enum import IntEnum

from pdr_core.records import Level


class Fault(IntEnum):
    """What can be wrong with the stamp of a sample."""

    NONE = 0
    DUPLICATE = 1
    EQUAL = 2
    UNSTAMPED = 3
    LATE = 4
    STRAY = 5
    BURST = 6
    GAP = 7
    BACK = 8
    FORTH = 9
    RATE = 10


OWN_CLOCK = "stamp by the sensor's clock or set intake.constant_rate_hz"
NOTICES = {
    Fault.DUPLICATE: ("duplicate_stamp", Level.WARN, "samples repeat the one before them, stamp and values: left out"),
    Fault.EQUAL: ("equal_stamps", Level.WARN, f"different samples have one stamp, only the first is used: {OWN_CLOCK}"),
    Fault.UNSTAMPED: ("no_stamp", Level.ERROR, "stamps are zero, only the first sample is used: let the driver stamp"),
    Fault.LATE: ("late_stamp", Level.WARN, "samples come after younger ones, left out: let one driver send, in order"),
    Fault.STRAY: ("stray_stamp", Level.WARN, "single stamps are far off all others, left out: check the driver"),
    Fault.BURST: ("burst", Level.WARN, f"samples wait and then come at once, stamped on arrival: {OWN_CLOCK}"),
    Fault.GAP: ("gap", Level.WARN, "samples are missing, the position is uncertain after the gap: check the link"),
    Fault.BACK: ("clock_jumped_back", Level.WARN, "the stamps jump back: the track goes on from where it was"),
    Fault.FORTH: (
        "clock_jumped_forth",
        Level.WARN,
        "the stamps jump ahead, a clock was set or the sensor slept: the track goes on from where it was",
    ),
    Fault.RATE: (
        "constant_rate",
        Level.WARN,
        "the samples do not come at intake.constant_rate_hz: set it to the sensor's rate",
    ),
}
