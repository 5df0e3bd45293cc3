"""Calibration of a magnetometer from a recording in which it is turned through all directions.

The derivation is in docs/magnetometer.md: the ellipsoid gives hard iron, and soft iron but for a rotation; the gyro
gives the rotation; the accelerometer the dip.
"""

from dataclasses import dataclass

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.intake.mag_axes import found_axes
from pdr_core.intake.mag_checks import (
    check_amount,
    check_dip,
    check_heading,
    check_strength,
    checked_ellipsoid,
    is_mirrored,
    rms,
)
from pdr_core.intake.mag_ellipsoid import deviation, fitted
from pdr_core.intake.mag_quality import coverage, dips_rad, heading_sd_rad
from pdr_core.records import Floats, ImuBlock

MOST = 20_000  # fields that are fitted; of more, evenly picked ones
USUAL_DIP_RAD = np.deg2rad(60.0)  # where the accelerometer does not tell it
RESTS = 20  # samples that do


@dataclass(frozen=True)
class MagCalibration:
    """calibrated = matrix (field - offset), in the axes of gyro and accelerometer, and how good that is."""

    offset_tesla: Floats  # (3,)
    matrix: Floats  # (3, 3)
    field_norm_tesla: float
    dip_rad: float | None  # None: the sensor was never still
    dip_sd_rad: float  # how much the dip differs between attitudes, without outliers
    residual_tesla: float  # rms of the distance from the ellipsoid
    heading_sd_rad: float  # by the calibration alone, in the worst attitude
    coverage: float  # share of all directions that were seen
    fields: int
    duration_s: float
    axes_from_gyro: bool  # else they are taken to be those of the gyro
    axes: Floats  # (3, 3) orthogonal: the rotation in `matrix`, of determinant -1 where axes are mirrored

    def applied(self, field_tesla: Floats) -> Floats:
        """Return fields, (n, 3) in the axes of the magnetometer, calibrated."""
        return (field_tesla - self.offset_tesla) @ self.matrix.T


def calibration(imu: ImuBlock, latitude_deg: float | None) -> MagCalibration:
    """Return the calibration by samples in SI units, their fields raw; CalibrationError if they do not determine it.

    The latitude tells mirrored axes, by the sign of the dip; None: they are not, and a field that points up is refused.
    """
    check_amount(imu)
    raw_tesla = imu.field_tesla[imu.field_sd_tesla >= 0.0]
    ellipsoid = checked_ellipsoid(fitted(raw_tesla[:: 1 + len(raw_tesla) // MOST]))
    axes = found_axes(imu, ellipsoid.sphere(imu.field_tesla))
    Q = axes.R.T if axes else np.eye(3)
    dip_rad, dip_sd_rad = dip_at_rest(imu, ellipsoid.sphere(imu.field_tesla) @ Q.T)
    seen = coverage(ellipsoid.sphere(raw_tesla))
    sd_rad = heading_sd_rad(ellipsoid, axes, USUAL_DIP_RAD if dip_rad is None else dip_rad)
    check_heading(sd_rad, seen)
    check_strength(ellipsoid.radius_tesla)
    check_dip(dip_sd_rad)
    if dip_rad is not None and is_mirrored(dip_rad, latitude_deg):
        Q, dip_rad = -Q, -dip_rad
    return MagCalibration(
        offset_tesla=ellipsoid.centre_tesla,
        matrix=Q @ ellipsoid.shape,
        field_norm_tesla=ellipsoid.radius_tesla,
        dip_rad=dip_rad,
        dip_sd_rad=dip_sd_rad,
        residual_tesla=rms(ellipsoid.residual_tesla),
        heading_sd_rad=sd_rad,
        coverage=seen,
        fields=len(raw_tesla),
        duration_s=float(imu.stamp_ns[-1] - imu.stamp_ns[0]) / NANOSECONDS,
        axes_from_gyro=axes is not None,
        axes=Q,
    )


def dip_at_rest(imu: ImuBlock, field: Floats) -> tuple[float | None, float]:
    """Return the dip of fields, (n, 3), and how much it differs between attitudes, where the sensor was slow enough."""
    each_rad = dips_rad(imu, field)
    if len(each_rad) < RESTS:
        return None, 0.0
    dip_rad = float(np.median(each_rad))
    return dip_rad, deviation(each_rad - dip_rad)
