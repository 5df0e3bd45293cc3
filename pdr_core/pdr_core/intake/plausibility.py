"""Does the data look like what it claims to be? Names wrong units, removed gravity and dead sensors."""

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.intake.first_look import FirstLook
from pdr_core.intake.range_end import ACCEL, GYRO, RangeEnd
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import within
from pdr_core.notices import Tally
from pdr_core.params import IntakeParams
from pdr_core.records import Flags, Floats, ImuBlock, Level

IMPOSSIBLE_RATE_RADPS = 60.0  # 3400 deg/s: no foot turns so fast, and hardly any gyro reaches it
MOVING_MPS2 = 30.0  # what a foot that walks from the first sample on may typically show
ABSURD = 1e6  # no sensor shows so much, in whatever unit, and the square of much more would drown all else


class Plausibility:
    """Looks at the first second of the accelerometer, at every sample of the gyro, and at the largest of both."""

    def __init__(self, params: IntakeParams) -> None:
        self._first_look = FirstLook()
        self._gyro_end = RangeEnd(GYRO, params.gyro_range_radps)
        self._accel_end = RangeEnd(ACCEL, params.accel_range_mps2)

    def watch(self, block: ImuBlock, tally: Tally) -> None:
        """Look at the next samples and tell the tally what is not plausible."""
        too_fast = np.abs(block.gyro_radps).max(axis=1, initial=0.0) > IMPOSSIBLE_RATE_RADPS
        text = "rates of over 60 rad/s: probably deg/s; set intake.gyro_unit, or the unit in the column map, to deg/s"
        tally.add_flagged("gyro_unit", Level.ERROR, text, too_fast, block.stamp_ns)
        if not self._first_look.over:
            self._look_at_accel(block, tally)
        self._gyro_end.watch(block.gyro_radps, block.stamp_ns, tally)
        self._accel_end.watch(block.accel_mps2, block.stamp_ns, tally)

    def _look_at_accel(self, block: ImuBlock, tally: Tally) -> None:
        norm_mps2 = self._first_look.typical(block.stamp_ns, np.linalg.norm(block.accel_mps2, axis=1))
        text = "" if norm_mps2 is None else verdict_on_norm(norm_mps2)
        if text:
            tally.add("accel_unit", Level.ERROR, text, self._first_look.start_ns)


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
    if STANDARD_GRAVITY_MPS2 < norm_mps2 < MOVING_MPS2:
        return measured + " in the first second: stand still then; if the foot did, check the unit and the calibration"
    return measured + ": check the unit and the calibration"
