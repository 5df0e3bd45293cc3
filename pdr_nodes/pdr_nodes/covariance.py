"""Covariances as others can use them: what is not known at all is a large number, not one that breaks their filter."""

import numpy as np

from pdr_core.records import Floats

LARGEST_POSE = np.array(3 * [1e10] + 3 * [np.pi**2])  # [m^2, rad^2] nobody can know less of an angle
LARGEST_TWIST = np.full(6, 1e4)  # [m^2/s^2, rad^2/s^2]


def bounded(covariance: Floats, largest: Floats) -> Floats:
    """Return a covariance (6, 6) whose variances are `largest` (6,) at most: scaled, so that it stays one."""
    variances = np.diag(covariance)
    if (variances <= largest).all():
        return covariance
    scale = np.sqrt(largest / np.maximum(variances, largest))
    return covariance * np.outer(scale, scale)
