"""Where the chest points: the yaw of an axis that is level, however the card is worn.

The yaw of the sensor's x axis is nothing where x points up, as on a card that is worn upright. So the first rest says
which axes count: those that were level and upright when the sensor was levelled with yaw 0. For a sensor whose x points
ahead they are nearly its own.
"""

import numpy as np

from pdr_core.chest.state import ChestState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import Quaternion, rows
from pdr_core.maths.vector import rotated


@compiled
def choose(level: Quaternion, state: ChestState) -> None:
    """Take the axes that point along those of the world, at the attitude of a rest with yaw 0."""
    for axis in range(3):
        state.level_axes[axis] = rows(level)[axis]


@compiled
def chest_yaw_rad(quat_xyzw: Quaternion, state: ChestState) -> float:
    """Return the yaw of the first of them, counter-clockwise from x of the world."""
    x, y, _ = rotated(rows(quat_xyzw), state.level_axes[0])
    return np.arctan2(y, x)
