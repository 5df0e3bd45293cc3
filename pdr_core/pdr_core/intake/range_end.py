"""Where a sensor's range ends, if an axis stops at one value again and again.

A board that has woken up in its smallest range (2 g, 250 deg/s) clips in every step, far below the range that the
parameters name. What is cut off is lost; a plateau of equal samples at the largest value of all is left each time.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.maths.compiled import compiled
from pdr_core.notices import Tally
from pdr_core.records import Floats, Level, Stamps

EQUAL = 1e-6  # of the value: a range ends at one number
LONG = 3  # samples of a plateau
OFTEN = 5  # plateaus
NEARLY = 0.99  # of a range that is named


class Kind(NamedTuple):
    """A sensor of three axes, and what is said of it; the limits are in SI, `unit` is that of the text."""

    kind: str
    text: str
    unit: float
    smallest: float  # below the smallest range sold
    ruinous: float  # what ends below it spoils every stride


# Simulated walk and the 25 m walk of xio, clipped: at 250 deg/s and at 2 g strides come out 2 to 23 % short and the
# height metres off, at 500 deg/s and at 4 g both are as before.
GYRO = Kind("gyro_range", "the gyro stops at {:.0f} deg/s", np.pi / 180.0, smallest=2.0, ruinous=6.0)
ACCEL = Kind("accel_range", "the accelerometer stops at {:.1f} g", STANDARD_GRAVITY_MPS2, smallest=18.0, ruinous=30.0)
ADVICE = " again and again, and what it should show there is lost: choose a larger range"


class Ends(NamedTuple):
    """Of three axes, positive and negative values each, (3, 2)."""

    largest: Floats
    equal: Stamps  # samples in a row that are the largest
    plateaus: Stamps


class RangeEnd:
    """Looks for the end of one sensor's range below the one that the parameters name."""

    def __init__(self, kind: Kind, named: float) -> None:
        self._kind = kind
        self._named = NEARLY * named
        self._ends = Ends(np.zeros((3, 2)), np.zeros((3, 2), np.int64), np.zeros((3, 2), np.int64))
        self._found = False

    def watch(self, values: Floats, stamp_ns: Stamps, tally: Tally) -> None:
        """Look at the next samples, (n, 3) with their stamps (n,), and tell the tally once."""
        if self._found:
            return
        at, end = found(values, self._ends, self._kind.smallest, self._named)
        self._found = end > 0.0
        if self._found:
            level = Level.ERROR if end < self._kind.ruinous else Level.WARN
            text = self._kind.text.format(end / self._kind.unit) + ADVICE
            tally.add(self._kind.kind, level, text, int(stamp_ns[at]))


@compiled
def found(values: Floats, ends: Ends, smallest: float, named: float) -> tuple[int, float]:
    """Return the sample of (n, 3) at which an end between both limits is known, and the end; 0.0 if none is."""
    for i in range(values.shape[0]):
        for axis in range(3):
            side = 0 if values[i, axis] >= 0.0 else 1
            ends.equal[axis, 1 - side] = 0
            if stops(ends, axis, side, abs(values[i, axis])) and smallest < ends.largest[axis, side] < named:
                return i, ends.largest[axis, side]
    return 0, 0.0


@compiled
def stops(ends: Ends, axis: int, side: int, value: float) -> bool:
    """Take the next value of an axis; return whether it has stopped at its largest often enough."""
    largest = ends.largest[axis, side]
    if value > largest * (1.0 + EQUAL):
        ends.largest[axis, side] = value
        ends.equal[axis, side], ends.plateaus[axis, side] = 1, 0
    elif value >= largest * (1.0 - EQUAL):
        ends.equal[axis, side] += 1
        ends.plateaus[axis, side] += ends.equal[axis, side] == LONG
    else:
        ends.equal[axis, side] = 0
    return ends.plateaus[axis, side] >= OFTEN
