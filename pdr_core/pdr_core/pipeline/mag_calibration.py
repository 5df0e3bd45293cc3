"""A magnetometer is calibrated by what ingestion makes of a recording, its own calibration left out."""

from collections.abc import Iterable
from dataclasses import dataclass

from pdr_core.intake import Ingestion
from pdr_core.intake.mag_calibration import MagCalibration as MagCalibration
from pdr_core.intake.mag_calibration import calibration
from pdr_core.intake.mag_checks import CalibrationError as CalibrationError
from pdr_core.params import IntakeParams, Params, changed
from pdr_core.records import NO_SAMPLES, Floats, ImuBlock, Notice, Stamps, joined

DEFAULTS = IntakeParams()
RAW = {
    name: value for name, value in vars(DEFAULTS).items() if name.startswith(("mag_offset", "mag_matrix", "mounting"))
}
EXPECTED = "mag_uncalibrated"  # what ingestion says of a magnetometer before


@dataclass(frozen=True)
class CalibratedRecording:
    """The calibration, the fields it was made from, and what was wrong with the samples."""

    calibration: MagCalibration
    stamp_ns: Stamps  # (n,)
    field_tesla: Floats  # (n, 3) raw
    notices: list[Notice]


def calibrate_magnetometer(
    pieces: Iterable[ImuBlock], params: Params, latitude_deg: float | None
) -> CalibratedRecording:
    """Return the calibration by the pieces of a recording in which the sensor is turned through all directions.

    Its axes are those of the sensor, which ingestion turns into the foot's. Raise CalibrationError, in one sentence,
    where the recording does not determine it. `latitude_deg`: None where nobody has said it.
    """
    intake = Ingestion(changed(params, "intake", **RAW).intake)
    imu = joined([NO_SAMPLES, *(intake.run(piece) for piece in pieces), intake.finish()])
    there = imu.field_sd_tesla >= 0.0
    notices = [notice for notice in intake.notices if notice.kind != EXPECTED]
    return CalibratedRecording(calibration(imu, latitude_deg), imu.stamp_ns[there], imu.field_tesla[there], notices)
