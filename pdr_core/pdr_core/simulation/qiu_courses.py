"""The walks of Qiu section 3: a rectangle in a room, a running track, a flight of stairs."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pdr_core.simulation.gait import STAIRS_UP, STROLL, WALK, Gait, Stride

CORNER = 2  # strides of a turn by 90 degrees
TURNED = 3  # strides of the half turn at the end, at least
TURNED_M = 0.4  # their length
FEWEST = 2 * (4 * CORNER + 4) + TURNED  # strides of two laps whose sides are one stride each, and of the half turn
LAP_M = 423.0  # along lane 4 (section 3.2)
STRAIGHT_M = 84.39  # of a track of 400 m
STAIRS, RISER_M, TREAD_M = 20, 0.16, 0.30  # section 3.1


def qiu_rectangle(strides: int, length_m: float) -> list[Stride]:
    """Return two laps clockwise round a rectangle and a half turn: ten right turns by 90 degrees, as figure 14 shows.

    The laps close. So the walk ends near its beginning with the reverse heading, as the paper has it. It has as many
    strides and is as long as asked, but never fewer than FEWEST, and then as long in proportion.
    """
    count = max(strides, FEWEST)
    turned = TURNED + (count - FEWEST) % 4  # the rest are four sides, twice
    sides = (count - turned - 8 * CORNER) // 4
    stride_m = (length_m * count / max(strides, 1) - turned * TURNED_M) / (count - turned)
    gait = replace(STROLL, length_m=stride_m)
    corner = turn_right(np.pi / 2.0, gait, CORNER)
    long_side, short_side = [Stride(gait)] * (sides - sides // 2), [Stride(gait)] * (sides // 2)
    lap = (long_side + corner + short_side + corner) * 2
    return lap * 2 + turn_right(np.pi, replace(STROLL, length_m=TURNED_M), turned)


def turn_right(angle_rad: float, gait: Gait, strides: int) -> list[Stride]:
    """Return a turn along an arc."""
    return [Stride(gait, turn_rad=-angle_rad / strides)] * strides


def track(strides: Sequence[int]) -> list[Stride]:
    """Return laps along lane 4, counter-clockwise, of so many strides each, from the beginning of a straight."""
    return [stride for count in strides for stride in lap(count)]


def lap(strides: int) -> list[Stride]:
    """Return two straights and two half circles; with an odd number of strides the second ones have one more."""
    bend_m = LAP_M / 2.0 - STRAIGHT_M
    halves = (strides // 2, strides - strides // 2)
    row: list[Stride] = []
    for half in halves:
        ahead = round(half * STRAIGHT_M / (STRAIGHT_M + bend_m))
        row += [Stride(replace(WALK, length_m=STRAIGHT_M / ahead))] * ahead + bend(bend_m / np.pi, half - ahead)
    return row


def bend(radius_m: float, strides: int) -> list[Stride]:
    """Return a half circle to the left; each stride is a chord."""
    turn_rad = np.pi / strides
    gait = replace(WALK, length_m=2.0 * radius_m * float(np.sin(turn_rad / 2.0)))
    return [Stride(gait, turn_rad=turn_rad)] * strides


def stair_climb(level: list[Stride]) -> list[Stride]:
    """Return a level walk, a flight of STAIRS, of which one foot takes two at a time, and the level walk again."""
    up = Stride(replace(STAIRS_UP, length_m=2.0 * TREAD_M), climb_m=2.0 * RISER_M)
    return [*level, *[up] * (STAIRS // 2), *level]
