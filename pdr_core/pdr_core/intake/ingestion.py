"""The intake of one sensor: raw samples in, trustworthy SI samples in the foot's axes out."""

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP, STANDARD_GRAVITY_MPS2
from pdr_core.intake.clip_stage import ClipRepair
from pdr_core.intake.noise import sample_noise
from pdr_core.intake.plausibility import Plausibility
from pdr_core.intake.stream_guard import FAULTS, Fault, GuardLimits, admitted, fresh_state
from pdr_core.maths import quaternion
from pdr_core.maths.vector import each_rotated
from pdr_core.notices import Tally
from pdr_core.params import IntakeParams
from pdr_core.records import Flags, Floats, ImuBlock, Level, Notice, Stamps

ACCEL_UNITS = {"m/s^2": 1.0, "g": STANDARD_GRAVITY_MPS2}
GYRO_UNITS = {"rad/s": 1.0, "deg/s": np.pi / 180.0}


class Ingestion:
    """Guards the stream, converts units, repairs clipped rates and turns the sensor's axes into the foot's.

    Samples at a rate that may be clipped are held back until it has fallen again: for `latency_s` at most.
    """

    def __init__(self, params: IntakeParams) -> None:
        self._params = params
        self._limits = GuardLimits(round(params.restart_s * NANOSECONDS))
        self._guard = fresh_state()
        self._plausibility = Plausibility()
        self._clip_repair = ClipRepair(params)
        self._last_ns = NO_STAMP
        self._tally = Tally()
        self._R_foot_from_sensor = quaternion.matrix(
            quaternion.from_euler(params.mounting_roll_rad, params.mounting_pitch_rad, params.mounting_yaw_rad)
        )

    def run(self, raw: ImuBlock) -> ImuBlock:
        """Return the samples, of these and earlier ones, that can be used: in SI units and foot axes, with their noise."""
        si = self._in_si_units(self._guarded(raw))
        self._plausibility.watch(si, self._tally)
        return self._in_foot_axes(self._with_noise(*self._clip_repair.run(si)))

    def finish(self) -> ImuBlock:
        """Return the samples that are still held back."""
        return self._in_foot_axes(self._with_noise(*self._clip_repair.finish()))

    @property
    def latency_s(self) -> float:
        """The longest time [s] for which a sample is held back."""
        return self._params.clip_longest_s

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the samples so far."""
        return self._tally.notices

    def _guarded(self, raw: ImuBlock) -> ImuBlock:
        raw = ImuBlock._make(np.ascontiguousarray(column) for column in raw)
        faults = admitted(raw, self._limits, self._guard)
        for fault, (kind, level, text) in FAULTS.items():
            self._tally.add_flagged(kind, level, text, faults == fault, raw.stamp_ns)
        passes = (faults == Fault.NONE) | (faults == Fault.GAP) | (faults == Fault.RESTART)
        return ImuBlock._make(column[passes] for column in raw)

    def _in_si_units(self, block: ImuBlock) -> ImuBlock:
        return block._replace(
            gyro_radps=block.gyro_radps * GYRO_UNITS[self._params.gyro_unit],
            accel_mps2=block.accel_mps2 * ACCEL_UNITS[self._params.accel_unit],
        )

    def _with_noise(self, block: ImuBlock, clipped: Flags) -> ImuBlock:
        p = self._params
        gyro_full = clipped | saturated(block.gyro_radps, p.gyro_range_radps)
        accel_full = saturated(block.accel_mps2, p.accel_range_mps2)
        gyro_off = block.gyro_sd_radps < 0.0
        self._note("gyro_saturated", "the gyro saturates: choose a larger range", gyro_full, block.stamp_ns)
        self._note("accel_saturated", "the accelerometer saturates: choose a larger range", accel_full, block.stamp_ns)
        self._note("gyro_off", "the gyro is off: the track is held until it is on again", gyro_off, block.stamp_ns)
        gyro_sd, accel_sd = sample_noise(block, self._intervals_s(block.stamp_ns), gyro_full, accel_full, p)
        return block._replace(gyro_sd_radps=np.where(gyro_off, -1.0, gyro_sd), accel_sd_mps2=accel_sd)

    def _intervals_s(self, stamps_ns: Stamps) -> Floats:
        interval_s = intervals_s(stamps_ns, self._last_ns, GAP_NS / NANOSECONDS)
        self._last_ns = int(stamps_ns[-1]) if len(stamps_ns) else self._last_ns
        return interval_s

    def _note(self, kind: str, text: str, flags: Flags, stamps_ns: Stamps) -> None:
        self._tally.add_flagged(kind, Level.WARN, text, flags, stamps_ns)

    def _in_foot_axes(self, block: ImuBlock) -> ImuBlock:
        return block._replace(
            gyro_radps=each_rotated(self._R_foot_from_sensor, block.gyro_radps),
            accel_mps2=each_rotated(self._R_foot_from_sensor, block.accel_mps2),
        )


def intervals_s(stamps_ns: Stamps, before_ns: int, longest_s: float) -> Floats:
    """Return the time [s] from each sample's predecessor, (n,), bounded by a gap's length, which the first one gets."""
    before = [before_ns] if before_ns != NO_STAMP else stamps_ns[:1]
    interval_s = np.diff(stamps_ns, prepend=np.asarray(before, np.int64)) / NANOSECONDS
    return np.where(interval_s > 0.0, np.minimum(interval_s, longest_s), longest_s)


def saturated(values: Floats, full_scale: float) -> Flags:
    """Return which samples (n, 3) have an axis within 0.5 % of the sensor's range, (n,)."""
    return np.abs(values).max(axis=1, initial=0.0) >= 0.995 * full_scale
