"""Zhou's figure 15: behaviours, modes and the gyro over standing, walking, running, walking, the manager in charge.

L0 and T0 are the defaults of the suite. What the foot does is told by its accelerometer at the rate of a sleeping
sensor, 50 Hz; how soon, counts from the first stride of what it does in truth. A second walk, 10 minutes round a
campus, shows for how long the gyro is on.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pdr_core.bench.zhou_walks import MAGNETOMETER_HZ, pieces, stands_s, told
from pdr_core.conventions import nanoseconds
from pdr_core.gait.accelerometer_steps import AccelerometerSteps, GaitSeen
from pdr_core.maths.thinning import thinned
from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import FootAdaptive
from pdr_core.records import joined, length
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import ModeCommand
from pdr_core.simulation import SimulatedWalk, simulated_walk
from pdr_core.simulation.foot_motion import REST_S
from pdr_core.simulation.gait import Stride
from pdr_core.simulation.walk import personal_strides

RATE_HZ, ASLEEP_HZ = 200, 50
PIECE_S = 0.5
TRANSITIONS_M, CAMPUS_M = 600.0, 720.0
STRIDING = (Behaviour.WALKING, Behaviour.RUNNING)


class Change(NamedTuple):
    """What the foot begins to do."""

    time_s: float
    behaviour: Behaviour


@dataclass(frozen=True)
class Transition:
    """A change of what the foot does, and when it was found."""

    before: str
    after: str
    true_s: float
    delay_s: float  # until it was known
    strides: float  # the same in strides of the new behaviour; of a walk or run: which was the first to be named so


@dataclass(frozen=True)
class Managed:
    """One walk with the manager in charge."""

    walk: str
    tester: str
    seed: int
    duration_s: float
    distance_m: float
    gyro_on_percent: float
    sensor_saved_percent: float
    end_error_m: float
    strides: int
    strides_true: int


class Timeline(NamedTuple):
    """What figure 15 shows."""

    true: list[Change]
    seen: list[Change]
    modes: list[ModeCommand]


def simulation(walk: str, length_m: float, tester: str, seed: int) -> SimulationParams:
    """Return the parameters of an outdoor walk."""
    return SimulationParams(
        motion="smooth",
        walk=walk,
        walk_length_m=length_m,
        tester=tester,
        sample_rate_hz=float(RATE_HZ),
        magnetometer=True,
        magnetometer_rate_hz=MAGNETOMETER_HZ,
        seed=seed,
    )


def managed(params: SimulationParams) -> tuple[Managed, list[ModeCommand], SimulatedWalk]:
    """Return what becomes of a walk, what the manager commanded, and the walk."""
    walk, chain = simulated_walk(params), FootAdaptive(told())
    outputs = [*map(chain.run, pieces(walk.imu, PIECE_S, RATE_HZ)), chain.finish()]
    end_m = joined([o.nav for o in outputs]).position_m[-1, :2]
    true_m, energy, strides = walk.motion.position_m[:, :2], chain.energy, personal_strides(params)
    result = Managed(
        params.walk,
        params.tester,
        params.seed,
        energy.duration_s,
        float(sum(stride.gait.length_m for stride in strides)),
        100.0 * energy.gyro_on_share,
        100.0 * energy.sensor_saved_share,
        float(np.linalg.norm(end_m - true_m[-1] + true_m[0])),
        sum(len(o.steps) for o in outputs),
        len(strides),
    )
    return result, chain.commands, walk


def done(strides: Sequence[Stride]) -> list[Change]:
    """Return what the foot does in truth: whenever something new begins."""
    row, now_s = [Change(0.0, Behaviour.STANDING)], REST_S
    for stride in strides:
        row.append(Change(now_s, stride.gait.behaviour))
        now_s += stride.duration_s
        if stride.pause_s:
            row.append(Change(now_s - stride.pause_s, Behaviour.STANDING))
    return changes([*row, Change(now_s, Behaviour.STANDING)])


def changes(row: Sequence[Change]) -> list[Change]:
    """Return those that differ from the one before."""
    return [now for now, before in zip(row, [None, *row], strict=False) if not before or now[1] is not before[1]]


def seen(walk: SimulatedWalk, params: Params) -> tuple[list[Change], GaitSeen]:
    """Return what the accelerometer shows, at the times at which it is known, and all that it has shown."""
    imu = thinned(walk.imu, 0, length(walk.imu), RATE_HZ // ASLEEP_HZ)
    shown = AccelerometerSteps(params.gait).run(imu)
    known_s = (shown.stamp_ns - walk.imu.stamp_ns[0] + nanoseconds(0.5 * params.gait.filter_s)) * 1e-9
    row = [Change(t, Behaviour(b)) for t, b in zip(known_s.tolist(), shown.behaviour.tolist(), strict=True)]
    return changes(row), shown


def transitions(strides: list[Stride], true: Sequence[Change], known: Sequence[Change], shown: GaitSeen,
                start_ns: int) -> list[Transition]:  # fmt: skip
    """Return how soon each change was found; a change that was not: infinity."""
    found, ends_s = [], stands_s(strides)[1:]
    for before, change, after in zip(true, true[1:], [*true[2:], Change(np.inf, Behaviour.UNKNOWN)], strict=False):
        until_s = after.time_s + 5.0
        at_s = [k.time_s for k in known if change.time_s <= k.time_s < until_s and k.behaviour is change.behaviour]
        delay_s = at_s[0] - change.time_s if at_s else np.inf
        first = int(np.searchsorted(ends_s, change.time_s))
        count = delay_s / strides[min(first, len(strides) - 1)].gait.duration_s
        if change.behaviour in STRIDING:
            count = named(shown, change, start_ns, ends_s, first)
        found.append(
            Transition(before.behaviour.name.lower(), change.behaviour.name.lower(), change.time_s, delay_s, count)
        )
    return found


def named(shown: GaitSeen, change: Change, start_ns: int, ends_s: np.ndarray, first: int) -> float:
    """Return which stride of a new gait was the first to be called so: 1, 2, ..."""
    for step in shown.steps:
        hit_s = (step.stamp_ns - start_ns) * 1e-9
        which = int(np.argmin(np.abs(ends_s - hit_s)))
        if which >= first and step.behaviour is change.behaviour:
            return which - first + 1.0
    return np.inf


def figure_15(tester: str, seed: int) -> tuple[Managed, list[Transition], Timeline]:
    """Return the walk through all behaviours."""
    params = simulation("transitions", TRANSITIONS_M, tester, seed)
    result, commands, walk = managed(params)
    strides, (known, shown) = personal_strides(params), seen(walk, told())
    true = done(strides)
    found = transitions(strides, true, known, shown, int(walk.imu.stamp_ns[0]))
    return result, found, Timeline(true, known, commands)


def ten_minutes(tester: str, seed: int) -> Managed:
    """Return the walk outdoors."""
    return managed(simulation("campus", CAMPUS_M, tester, seed))[0]
