"""Does the data look like what it claims to be? Names wrong units, removed gravity and dead sensors."""

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP, STANDARD_GRAVITY_MPS2
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import within
from pdr_core.notices import Tally
from pdr_core.records import Flags, Floats, ImuBlock, Level

FIRST_LOOK_S = 1.0
IMPOSSIBLE_RATE_RADPS = 60.0  # 3400 deg/s: no foot turns so fast, and hardly any gyro reaches it

ABSURD = 1e6  # no sensor shows so much, in whatever unit, and the square of much more would drown all else


class Plausibility:
    """Looks at the first second of the accelerometer and at every sample of the gyro."""

    def __init__(self) -> None:
        self._start_ns = NO_STAMP
        self._norms_mps2: list[float] = []
        self._judged = False

    def watch(self, block: ImuBlock, tally: Tally) -> None:
        """Look at the next samples and tell the tally what is not plausible."""
        too_fast = np.abs(block.gyro_radps).max(axis=1, initial=0.0) > IMPOSSIBLE_RATE_RADPS
        text = "rates of over 60 rad/s: probably deg/s; set intake.gyro_unit, or the unit in the column map, to deg/s"
        tally.add_flagged("gyro_unit", Level.ERROR, text, too_fast, block.stamp_ns)
        if not self._judged:
            self._look_at_accel(block, tally)

    def _look_at_accel(self, block: ImuBlock, tally: Tally) -> None:
        if not len(block.stamp_ns):
            return
        if self._start_ns == NO_STAMP:
            self._start_ns = int(block.stamp_ns[0])
        first_look = block.stamp_ns - self._start_ns < FIRST_LOOK_S * NANOSECONDS
        self._norms_mps2.extend(np.linalg.norm(block.accel_mps2[first_look], axis=1).tolist())
        if not first_look.all():
            self._judged = True
            text = verdict_on_norm(float(np.median(self._norms_mps2)))
            if text:
                tally.add("accel_unit", Level.ERROR, text, self._start_ns)


@compiled
def plausible(gyro: Floats, accel: Floats) -> Flags:
    """Return which samples, (n, 3) each in whatever unit, hold nothing but numbers that a sensor may show, (n,)."""
    good = np.empty(gyro.shape[0], np.bool_)
    for i in range(gyro.shape[0]):
        good[i] = within(gyro[i], ABSURD) and within(accel[i], ABSURD)
    return good


def verdict_on_norm(norm_mps2: float) -> str:
    """Return what is wrong with a typical magnitude of specific force [m/s^2], or nothing."""
    if abs(norm_mps2 / STANDARD_GRAVITY_MPS2 - 1.0) < 0.2:
        return ""
    measured = f"the acceleration is typically {norm_mps2:.3g} m/s^2 instead of 9.81"
    if abs(norm_mps2 - 1.0) < 0.2:
        return measured + ": probably in g; set intake.accel_unit, or the unit in the column map, to g"
    if norm_mps2 < 0.5:
        return measured + ": gravity seems to be removed; use the raw acceleration of the driver"
    return measured + ": check the unit and the calibration"
