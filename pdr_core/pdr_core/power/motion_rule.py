"""The rule by which a sensor switches its gyro, from the parameters: one for offline, the driver and what bridges."""

from pdr_core.conventions import nanoseconds
from pdr_core.maths.motion_switch import MotionRule
from pdr_core.params import PowerParams
from pdr_core.power.parts import PARTS


def motion_rule(params: PowerParams) -> MotionRule:
    """Return the rule by which the sensor switches its gyro."""
    return MotionRule(
        params.wake_mps2,
        params.quiet_mps2,
        params.strike_mps2,
        nanoseconds(params.strike_on_s),
        nanoseconds(params.swing_least_s),
        nanoseconds(PARTS[params.part].start_s),
    )
