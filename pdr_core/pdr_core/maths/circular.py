"""Angles that begin anew after a period: a whole turn, or a part of it where directions are alike."""

from collections.abc import Sequence

import numpy as np

from pdr_core.maths.compiled import compilable

TURN_RAD = 2.0 * np.pi


@compilable
def wrapped_rad(angle_rad: float, period_rad: float = TURN_RAD) -> float:
    """Return the angle that is the same but for whole periods, from -period / 2 up to period / 2."""
    return float((angle_rad + period_rad / 2.0) % period_rad - period_rad / 2.0)


def circular_mean_rad(angles_rad: Sequence[float]) -> float:
    """Return the direction of the sum of unit vectors at these angles, -pi .. pi; ValueError of none."""
    if not len(angles_rad):
        raise ValueError("no angle has no mean")
    return float(np.arctan2(np.mean(np.sin(angles_rad)), np.mean(np.cos(angles_rad))))
