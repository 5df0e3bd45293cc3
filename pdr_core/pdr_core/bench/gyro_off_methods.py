"""Where the strides of the second half may go, by what the first half has taught."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pdr_core.bench.gyro_off_walk import GyroOffWalk
from pdr_core.gait.heading_deviation import HeadingDeviation, chord_rad
from pdr_core.gait.stance_heading import StanceHeading, field_of
from pdr_core.gait.turn_suspicion import TurnSuspicion, across_mps
from pdr_core.maths.circular import circular_mean_rad, wrapped_rad
from pdr_core.params import DeadReckoningParams, Params
from pdr_core.records_gait import Angle, Behaviour, FieldHeading

GYRO_TURN_SD_RAD = 0.01


@dataclass(frozen=True)
class Taught:
    """A walk, and what its first half has taught."""

    walk: GyroOffWalk
    params: DeadReckoningParams
    deviation: Angle
    suspicion: TurnSuspicion
    heading: StanceHeading
    north_rad: float  # mean azimuth of the field, clean or not
    across_mps: list[float | None]  # of every stride of the walk


@dataclass(frozen=True)
class Stride:
    """What a method says of a stride."""

    turn: Angle
    deviation: Angle
    heading: FieldHeading | None = None
    gyro_on: bool = False


def taught(walk: GyroOffWalk, params: Params) -> Taught:
    """Let the first half teach."""
    known = HeadingDeviation(params.dead_reckoning)
    suspicion, heading = TurnSuspicion(params.dead_reckoning), StanceHeading(params.filter, params.dead_reckoning)
    sds_rad = np.sqrt(walk.nav.pose_covariance[:, 5, 5])
    yaws = [Angle(*pair) for pair in np.column_stack([walk.yaws_rad, sds_rad]).tolist()]
    for i in range(walk.half):
        known.learn(Behaviour.WALKING, walk.steps[i], yaws[i].rad, yaws[i + 1])
    deviation = known.deviation(Behaviour.WALKING)
    across = [across_mps(s.impulse_mps, deviation.rad) if s.impulse_mps is not None else None for s in walk.stands[1:]]
    norths = []
    for i in range(walk.half):
        if (impulse := across[i]) is not None:
            suspicion.learn(impulse, float(walk.turns_rad[i]))
        heading.learn(walk.stands[i + 1], yaws[i + 1])
        if field := field_of(walk.stands[i + 1]):
            norths.append(yaws[i + 1].rad + field.azimuth_rad)
    return Taught(
        walk, params.dead_reckoning, deviation, suspicion, heading, circular_mean_rad(norths) if norths else 0.0, across
    )


Method = Callable[[Taught], Sequence[Stride]]  # of the strides of the second half


def by_gyro(taught: Taught) -> Sequence[Stride]:
    """Return the strides of the filter, whose gyro stays on."""
    return [by_filter(taught.walk, i) for i in range(taught.walk.half, len(taught.walk.steps))]


def by_filter(walk: GyroOffWalk, i: int) -> Stride:
    """Return what the filter with its gyro says of a stride: how the foot turns and where it goes."""
    turn_rad = float(walk.turns_rad[i])
    along_m = walk.nav.position_m[i + 1] - walk.nav.position_m[i]
    own_rad = wrapped_rad(float(np.arctan2(along_m[1], along_m[0])) - chord_rad(*walk.yaws_rad[i : i + 2].tolist()))
    return Stride(Angle(turn_rad, GYRO_TURN_SD_RAD), Angle(own_rad, GYRO_TURN_SD_RAD), gyro_on=True)


def by_gyro_yaw(taught: Taught) -> Sequence[Stride]:
    """Return strides of which the gyro, which stays on, tells no more than the yaw of the foot."""
    return [
        Stride(Angle(float(turn), GYRO_TURN_SD_RAD), taught.deviation, gyro_on=True)
        for turn in taught.walk.turns_rad[taught.walk.half :]
    ]


def by_holding(taught: Taught) -> Sequence[Stride]:
    """Return strides whose heading is held."""
    return [Stride(taught.suspicion.turn(None), taught.deviation) for _ in taught.walk.steps[taught.walk.half :]]


def by_any_field(taught: Taught) -> Sequence[Stride]:
    """Return strides to where any field shows, as if all were the Earth's: as Zhou does."""
    strides, yaw = [], float(taught.walk.yaws_rad[taught.walk.half])
    for stand in taught.walk.stands[taught.walk.half + 1 :]:
        field = field_of(stand)
        turn_rad = wrapped_rad(taught.north_rad - field.azimuth_rad - yaw) if field else 0.0
        strides.append(Stride(Angle(turn_rad, taught.params.held_turn_sd_rad), taught.deviation))
        yaw += turn_rad
    return strides


def with_field(method: Method) -> Method:
    """Return a method that takes what the field tells besides, as uncertain as it is."""

    def method_with_field(taught: Taught) -> Sequence[Stride]:
        headings = [taught.heading.heading(stand) for stand in taught.walk.stands[taught.walk.half + 1 :]]
        strides = method(taught)
        return [replace(stride, heading=seen) for stride, seen in zip(strides, headings, strict=True)]

    return method_with_field


def by_impulse(taught: Taught) -> Sequence[Stride]:
    """Return strides whose turns the accelerometer tells."""
    return [Stride(taught.suspicion.turn(x), taught.deviation) for x in taught.across_mps[taught.walk.half :]]


def by_waking(taught: Taught) -> Sequence[Stride]:
    """Return strides with the gyro on in each that is suspected, as if it woke in time."""
    impulses = taught.across_mps[taught.walk.half :]
    return [
        by_filter(taught.walk, i)
        if taught.suspicion.suspected(x)
        else Stride(taught.suspicion.turn(x), taught.deviation)
        for i, x in enumerate(impulses, taught.walk.half)
    ]


def by_waking_late(taught: Taught) -> Sequence[Stride]:
    """Return strides with the gyro on after each that is suspected, until a calm one; itself is told by its impulse."""
    strides: list[Stride] = []
    for i, x in enumerate(taught.across_mps[taught.walk.half :], taught.walk.half):
        awake = bool(strides) and abs(strides[-1].turn.rad) > taught.params.suspicion_rad
        strides.append(by_filter(taught.walk, i) if awake else Stride(taught.suspicion.turn(x), taught.deviation))
    return strides


METHODS: dict[str, Method] = {
    "gyro": by_gyro,
    "gyro yaw": by_gyro_yaw,
    "held": by_holding,
    "any field": by_any_field,
    "held, field": with_field(by_holding),
    "impulse": by_impulse,
    "impulse, field": with_field(by_impulse),
    "woken": by_waking,
    "woken, field": with_field(by_waking),
    "woken late": by_waking_late,
    "woken late, field": with_field(by_waking_late),
}
