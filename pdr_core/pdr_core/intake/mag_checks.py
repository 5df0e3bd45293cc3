"""What a recording must show before a magnetometer is calibrated by it. Each refusal says what to do."""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.intake.mag_ellipsoid import Ellipsoid
from pdr_core.records import Floats, ImuBlock

FEWEST, SHORTEST_S = 200, 5.0
HEADING_SD_MAX_RAD = np.deg2rad(1.0)
RESIDUAL_MAX = 0.05  # of the field: more is no noise
STRENGTH_TESLA = (15e-6, 100e-6)  # of the Earth's field, with room for errors of the scale and for buildings
DIP_SD_MAX_RAD = np.deg2rad(5.0)
SURE_DIP_RAD = np.deg2rad(20.0)  # a flatter field does not tell mirrored axes from a place south of the equator
TURN = "turn the sensor slowly through all directions, far from iron, and record that"


class CalibrationError(ValueError):
    """The recording does not determine a calibration; the text says in one sentence what to do."""


def check_amount(imu: ImuBlock) -> None:
    """Refuse a recording with hardly any field."""
    stamps_ns = imu.stamp_ns[imu.field_sd_tesla >= 0.0]
    if not len(stamps_ns):
        raise CalibrationError(
            "there is no magnetic field: record imu/mag too, or name its columns in the column map, as mag"
        )
    lasted_s = float(stamps_ns.max() - stamps_ns.min()) / NANOSECONDS
    if len(stamps_ns) < FEWEST or lasted_s < SHORTEST_S:
        raise CalibrationError(f"there are only {len(stamps_ns)} fields in {lasted_s:.1f} s: {TURN} for half a minute")


def checked_ellipsoid(ellipsoid: Ellipsoid | None) -> Ellipsoid:
    """Refuse fields that lie on no ellipsoid, or are scattered about it."""
    if ellipsoid is None:
        raise CalibrationError(f"the fields do not lie on an ellipsoid: {TURN}")
    scatter = rms(ellipsoid.residual_tesla) / ellipsoid.radius_tesla
    if scatter > RESIDUAL_MAX:
        raise CalibrationError(f"the fields scatter by {scatter:.0%} about the best ellipsoid: {TURN}")
    return ellipsoid


def check_strength(norm_tesla: float) -> None:
    """Refuse a field that is too weak or strong for the Earth's."""
    if not STRENGTH_TESLA[0] <= norm_tesla <= STRENGTH_TESLA[1]:
        raise CalibrationError(
            f"the field would be {norm_tesla * 1e6:.3g} uT strong, the Earth's is 22 to 67: set intake.mag_unit, or "
            "the unit in the column map, or record far from iron"
        )


def check_dip(dip_sd_rad: float) -> None:
    """Refuse axes that do not fit the accelerometer's."""
    if dip_sd_rad > DIP_SD_MAX_RAD:
        raise CalibrationError(
            f"the dip differs by {np.rad2deg(dip_sd_rad):.0f} deg between attitudes, so the axes of magnetometer and "
            f"accelerometer do not fit together: with the gyro on, {TURN}"
        )


def check_heading(sd_rad: float, coverage: float) -> None:
    """Refuse a calibration that the fields do not determine."""
    if not sd_rad <= HEADING_SD_MAX_RAD:
        raise CalibrationError(
            f"the {coverage:.0%} of all directions that were seen leave the heading uncertain by "
            f"{min(np.rad2deg(sd_rad), 180.0):.1f} deg: {TURN}"
        )


def is_mirrored(dip_rad: float, latitude_deg: float | None) -> bool:
    """Return whether the field must be turned round for its dip to have the sign of the latitude, where it is given.

    The gyro cannot tell it: if m obeys dm/dt = -w x m, so does -m.
    """
    if abs(dip_rad) < SURE_DIP_RAD:
        return False
    if latitude_deg is None and dip_rad < 0.0:
        raise CalibrationError(
            f"the field points {np.rad2deg(-dip_rad):.0f} deg up, as it does south of the equator or where axes are "
            "mirrored: set place.latitude_deg in a file for --params"
        )
    return latitude_deg is not None and dip_rad * latitude_deg < 0.0


def rms(values: Floats) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(values**2)))
