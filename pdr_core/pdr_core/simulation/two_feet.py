"""Both feet of one person: where each stands, and when each swings.

The row of strides that moves a single foot is here the way of the body, midway between the feet. It is cut into steps;
at the end of each one foot comes down beside the way, the left one first. So each foot makes strides of the whole
length, half a stride apart, the first and the last step are half a stride, and in a curve the outer foot goes farther.
Both begin and end side by side.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pdr_core.params import SimulationParams
from pdr_core.records import Floats
from pdr_core.simulation.foot_motion import REST_S, Swings, SwungFoot, stands
from pdr_core.simulation.gait import Stride

SIDES = {"left": 1.0, "right": -1.0}
PLACEMENT = 10  # this stream of a seed


def both_feet(strides: Sequence[Stride], params: SimulationParams) -> Mapping[str, SwungFoot]:
    """Return the motion of both feet, by name, along a way that begins at the origin along x."""
    way = list(steps(strides, params.double_support))
    places, toe_off_s = stands(way), toe_offs_s(way)
    duration_s = float(toe_off_s[-1]) + settling_s(way[-1]) + REST_S if way else 2.0 * REST_S
    placed_m = placement_m(len(places), params)
    gaits = [s.gait for s in [*way, *way[-1:]]]
    after = np.minimum(np.arange(1, len(gaits) + 1), len(way))  # the place that each step leads to
    courses = {}
    for first, (name, side) in enumerate(SIDES.items()):
        at = np.append(0, after[first::2])
        beside, bow_m = feet(places, placed_m, side, params)[at], bows_m(feet(places, 0.0 * placed_m, side, params), at)
        courses[name] = SwungFoot(Swings(gaits[first::2], toe_off_s[first::2], beside, bow_m, duration_s, side))
    return courses


def bows_m(beside: Floats, at: NDArray[np.intp]) -> Floats:
    """Return how far from the straight line each swing passes the other foot, which stands amid, (swings, 2).

    `beside` is where this foot would stand at every place, (n, 4), `at` the places where it does, (swings + 1,).
    """
    plan, before, after = beside[:, :2], at[:-1], at[1:]
    amid_m = plan[before + 1] - 0.5 * (plan[before] + plan[after])
    ahead = plan[after] - plan[before]
    left = np.column_stack([-ahead[:, 1], ahead[:, 0]])
    left /= np.maximum(np.linalg.norm(left, axis=1, keepdims=True), 1e-9)
    across_m = np.sum(amid_m * left, axis=1) * (after - before == 2)
    return across_m[:, None] * left


def steps(strides: Sequence[Stride], double_support: float) -> Iterator[Stride]:
    """Yield two steps for each stride: two chords of the same arc, each half as long, half as steep and half the turn.

    A chord c of the turn a is 2 r sin(a / 2), that of half the turn 2 r sin(a / 4) = c / (2 cos(a / 4)).
    """
    for s in strides:
        length_m = s.gait.length_m / (2.0 * np.cos(s.turn_rad / 4.0))
        gait = replace(s.gait.with_double_support(double_support), length_m=length_m)
        step = Stride(gait, 0.5 * s.turn_rad, 0.5 * s.climb_m)
        yield from (step, replace(step, pause_s=s.pause_s))


def toe_offs_s(way: Sequence[Stride]) -> Floats:
    """Return when each step begins, and the one that brings the last foot beside the other, (steps + 1,).

    Between two toe-offs lies half a stride: the mean of both, where they differ.
    """
    if not way:
        return np.zeros(0)
    stride_s = np.array([s.gait.duration_s for s in [*way, way[-1]]])
    between_s = 0.25 * (stride_s[:-1] + stride_s[1:]) + [s.pause_s for s in way]
    return REST_S + way[0].gait.heel_off_s + np.concatenate([[0.0], np.cumsum(between_s)])


def settling_s(last: Stride) -> float:
    """Return how long the last step takes from toe-off to the end of its stride."""
    return last.gait.duration_s - last.gait.heel_off_s + last.pause_s


def placement_m(count: int, params: SimulationParams) -> Floats:
    """Return how far each foot comes down from where it should, (count, 2) along and across; not at both ends."""
    spread = np.random.default_rng([params.seed, PLACEMENT]).standard_normal((count, 2))
    spread[[0, -1]] = 0.0
    return params.placement_sd_m * spread


def feet(places: Floats, placed_m: Floats, side: float, params: SimulationParams) -> Floats:
    """Return where a foot of this side stands beside places of the way (n, 4): x, y, z, yaw, (n, 4)."""
    x, y, z, heading = places.T
    along, left = placed_m[:, 0], placed_m[:, 1] + 0.5 * side * params.feet_apart_m
    return np.column_stack(
        [
            x + along * np.cos(heading) - left * np.sin(heading),
            y + along * np.sin(heading) + left * np.cos(heading),
            z,
            heading + side * params.toe_out_rad,
        ]
    )
