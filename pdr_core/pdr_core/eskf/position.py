"""Position: somebody beyond the filter knows by how much the place is off.

What is known is known of the place where the foot stood last; it is taken at the moment at which the answer applies, a
swing later at most, in which the error of the place hardly changes.
"""

from pdr_core.eskf.error_state import POSITION, observing
from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats

H = observing(POSITION)


@compiled
def residual(position_error_m: Floats) -> Floats:
    """Return truth minus estimate, (3,) [m]."""
    return -position_error_m
