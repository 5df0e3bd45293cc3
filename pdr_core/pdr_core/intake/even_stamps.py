"""Even stamps for samples that were stamped on arrival: a first-order loop that follows the stamps slowly."""

from pdr_core.conventions import GAP_NS
from pdr_core.intake.stamp_faults import Fault
from pdr_core.intake.stamp_state import StampState
from pdr_core.maths.compiled import compiled

SETTLING_NS = 500_000_000  # time in which a difference to the stamps dies away


@compiled
def even_stamp(stamp_ns: int, fault: int, period_ns: int, state: StampState) -> tuple[int, bool]:
    """Set `state.out_ns`, one period and a share of the difference on; return the fault, and whether the sample passes.

    A difference of a gap is none that arrival explains: samples are missing, or the rate is wrong by a fifth or more.
    """
    ahead_ns = stamp_ns - (state.out_ns + period_ns)
    if fault == Fault.BACK or fault == Fault.FORTH:
        state.out_ns = stamp_ns
        return fault, True
    if ahead_ns > GAP_NS:
        state.out_ns = stamp_ns
        return (Fault.GAP if fault == Fault.GAP else Fault.RATE), True
    if ahead_ns < -GAP_NS:
        return Fault.RATE, False
    state.out_ns += period_ns + ahead_ns * period_ns // SETTLING_NS
    return Fault.NONE, True
