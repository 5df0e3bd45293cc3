"""A turn taken apart: the twist about an axis, and the shortest turn that moves the axis (swing and twist)."""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import Four, Quaternion, normalised
from pdr_core.maths.vector import Vector, cross, dot


@compiled
def twist_rad(turn: Quaternion, axis: Vector) -> float:
    """Return by how much a turn, a unit quaternion, turns about a unit axis, -pi..pi."""
    twist = 2.0 * np.arctan2(dot((turn[0], turn[1], turn[2]), axis), turn[3])
    return twist - 2.0 * np.pi * np.round(twist / (2.0 * np.pi))


@compiled
def shortest_turn(before: Vector, after: Vector) -> Four:
    """Return the turn of least angle that takes one unit vector to another; of opposite ones, no turn."""
    x, y, z = cross(before, after)
    w = 1.0 + dot(before, after)  # cos and sin of the whole angle, doubled into those of its half
    return normalised((x, y, z, w)) if w > 1e-9 else (0.0, 0.0, 0.0, 1.0)
