"""The intake of one sensor: raw samples in, trustworthy SI samples in the foot's axes out."""

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.intake.clip_stage import ClipRepair
from pdr_core.intake.magnetometer import Magnetometer
from pdr_core.intake.noise import channels, sample_noise
from pdr_core.intake.plausibility import Plausibility, plausible
from pdr_core.intake.rate_look import RateLook
from pdr_core.intake.stamp_policy import StampPolicy
from pdr_core.maths import quaternion
from pdr_core.maths.vector import each_rotated
from pdr_core.notices import Tally
from pdr_core.params import IntakeParams
from pdr_core.records import NO_SAMPLES, Flags, ImuBlock, Level, Notice, Stamps, joined, length

ACCEL_UNITS = {"m/s^2": 1.0, "g": STANDARD_GRAVITY_MPS2}
GYRO_UNITS = {"rad/s": 1.0, "deg/s": np.pi / 180.0}


class Ingestion:
    """Leaves out what is no number, sees to the stamps, converts units, repairs clipped rates and turns the axes.

    A field that is no measurement costs a sample nothing but this field.

    Samples at a rate that may be clipped are held back until it has fallen again: for `latency_s` at most.
    """

    def __init__(self, params: IntakeParams) -> None:
        self._params = params
        self._stamps = StampPolicy(params)
        self._clip_repair = ClipRepair(params)
        self._gyro, self._accel = channels(params)
        self._last = NO_SAMPLES
        self._plausibility = Plausibility(params)
        self._rate_look = RateLook()
        self._tally = Tally()
        self._R_foot_from_sensor = quaternion.matrix(
            quaternion.from_euler(params.mounting_roll_rad, params.mounting_pitch_rad, params.mounting_yaw_rad)
        )
        self._magnetometer = Magnetometer(params, self._R_foot_from_sensor)

    def run(self, raw: ImuBlock) -> ImuBlock:
        """Return what can be used of these samples and of those that waited: in SI units, foot axes, with noise."""
        self._rate_look.watch(raw.stamp_ns, self._tally)
        return self._conditioned(*self._repaired(self._stamps.run(self._numbers(raw))))

    def finish(self) -> ImuBlock:
        """Return the samples that still wait for later ones."""
        last = self._conditioned(*self._repaired(self._stamps.finish()))
        return joined([last, self._conditioned(*self._clip_repair.finish())])

    @property
    def latency_s(self) -> float:
        """The longest time [s] for which a sample with a good stamp is held back."""
        return self._params.clip_longest_s

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the samples so far."""
        return self._tally.notices + self._stamps.notices + self._magnetometer.notices

    def _numbers(self, raw: ImuBlock) -> ImuBlock:
        raw = ImuBlock._make(np.ascontiguousarray(column) for column in raw)
        good = plausible(raw.gyro_radps, raw.accel_mps2)
        if good.all():
            return raw
        self._note("not_finite", "samples hold NaN, infinity or absurd numbers: left out", ~good, raw.stamp_ns)
        return ImuBlock._make(column[good] for column in raw)

    def _repaired(self, good: ImuBlock) -> tuple[ImuBlock, Flags]:
        si = self._in_si_units(good)
        self._plausibility.watch(si, self._tally)
        return self._clip_repair.run(si)

    def _conditioned(self, si: ImuBlock, clipped: Flags) -> ImuBlock:
        return self._magnetometer.run(self._in_foot_axes(self._with_noise(si, clipped)))

    def _in_si_units(self, block: ImuBlock) -> ImuBlock:
        return block._replace(
            gyro_radps=block.gyro_radps * GYRO_UNITS[self._params.gyro_unit],
            accel_mps2=block.accel_mps2 * ACCEL_UNITS[self._params.accel_unit],
        )

    def _with_noise(self, si: ImuBlock, clipped: Flags) -> ImuBlock:
        gyro_sd, accel_sd, gyro_full, accel_full = sample_noise(si, clipped, self._last, self._gyro, self._accel)
        if length(si):
            self._last = ImuBlock._make(column[-1:].copy() for column in si)
        self._note("gyro_saturated", "the gyro saturates: choose a larger range", gyro_full, si.stamp_ns)
        self._note("accel_saturated", "the accelerometer saturates: choose a larger range", accel_full, si.stamp_ns)
        self._note("gyro_off", "the gyro is off: the track is held until it is on again", gyro_sd < 0.0, si.stamp_ns)
        return si._replace(gyro_sd_radps=gyro_sd, accel_sd_mps2=accel_sd)

    def _note(self, kind: str, text: str, flags: Flags, stamps_ns: Stamps) -> None:
        self._tally.add_flagged(kind, Level.WARN, text, flags, stamps_ns)

    def _in_foot_axes(self, block: ImuBlock) -> ImuBlock:
        return block._replace(
            gyro_radps=each_rotated(self._R_foot_from_sensor, block.gyro_radps),
            accel_mps2=each_rotated(self._R_foot_from_sensor, block.accel_mps2),
        )
