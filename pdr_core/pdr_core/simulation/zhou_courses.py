"""The walks of Zhou section 5: an octagon in laps (figure 6), and standing, walking, running, walking (figure 15)."""

from dataclasses import replace

import numpy as np

from pdr_core.simulation.gait import Gait, Stride

LAP_M = 175.0  # a total error of 1.00 m is 0.57 %, one of 9.29 m is 5.30 % (Zhou Tables 5 and 7)
SIDES, CORNER = 8, 2  # corners of 45 degrees in two strides
SWINGS = 4
STAND_S = 5.0  # on both sides of what is done on the spot


def octagon(length_m: float, gait: Gait) -> list[Stride]:
    """Return laps to the left round a regular octagon, each of LAP_M, as many as `length_m` has, at least one."""
    count = round(LAP_M / SIDES / gait.length_m)
    fitted = replace(gait, length_m=LAP_M / SIDES / count)
    side = [Stride(fitted)] * (count - CORNER) + [Stride(fitted, turn_rad=2.0 * np.pi / SIDES / CORNER)] * CORNER
    return side * SIDES * max(1, round(length_m / LAP_M))


def corners(strides: list[Stride]) -> list[int]:
    """Return after which strides the foot stands in a corner: amid those that turn."""
    turning = [i for i, stride in enumerate(strides, 1) if stride.turn_rad]
    return turning[CORNER // 2 - 1 :: CORNER]


def transitions(length_m: float, swing: Gait, walk: Gait, run: Gait) -> list[Stride]:
    """Return a stand, a foot that swings on the spot, another stand, and a third each of walk, run and walk."""
    part_m = length_m / 3.0
    swings = [Stride(swing)] * SWINGS
    walked, ran = ([Stride(gait)] * max(1, round(part_m / gait.length_m)) for gait in (walk, run))
    return [*swings[1:], replace(swings[0], pause_s=STAND_S), *walked, *ran, *walked]
