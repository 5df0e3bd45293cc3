"""Which signs of a turn can be seen with the gyro off: detection rates at a given rate of false alarms.

What the first half of a walk teaches is used on its second half. A sign is the distance of a stride's value from the
median of the first half's straight strides; the impulse is taken as `TurnSuspicion` does, as the size of the turn it
tells. A stride turns if the filter with the gyro says so, by more than TURN_RAD.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import rankdata

from pdr_core.bench.gyro_off_methods import taught
from pdr_core.bench.gyro_off_walk import GyroOffWalk
from pdr_core.gait.stance_heading import field_of
from pdr_core.gait.stands import Stand
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import Params
from pdr_core.records import Flags, Floats

TURN_RAD = float(np.radians(10.0))
FALSE_ALARMS = (0.1, 0.3)
IMPULSE = "impulse across, learnt"


@dataclass(frozen=True)
class Roc:
    """How one sign tells turns, over the second halves of some walks."""

    sign: str
    strides: int
    turning: float  # share of them
    area: float  # under the curve: 0.5 says nothing, 1 says all
    detected: tuple[float, ...]  # at the rates of FALSE_ALARMS


Sign = Callable[[Stand, Stand], float]  # of the stands before and after


def difference(index: int) -> Sign:
    """Return the change of a part of the field: 0 strength, as a share of it, 1 dip, 2 azimuth about the foot."""

    def sign(before: Stand, after: Stand) -> float:
        fields = field_of(before), field_of(after)
        if fields[0] is None or fields[1] is None:
            return 0.0
        change = fields[1][index] - fields[0][index]
        return change / fields[0].norm_tesla if index == 0 else wrapped_rad(change)

    return sign


def tilted_rad(before: Stand, after: Stand) -> float:
    """Return by how much the foot stands otherwise."""
    up = [stand.force_mps2 / np.linalg.norm(stand.force_mps2) for stand in (before, after)]
    return float(np.arccos(np.clip(up[0] @ up[1], -1.0, 1.0)))


SIGNS: dict[str, Sign] = {
    "impulse across the foot": lambda _, after: float(after.impulse_mps[1]) if after.impulse_mps is not None else 0.0,
    "impulse along the foot": lambda _, after: float(after.impulse_mps[0]) if after.impulse_mps is not None else 0.0,
    "duration": lambda before, after: (after.stamp_ns - before.stamp_ns) * 1e-9,
    "tilt of the stand": tilted_rad,
    "field azimuth": difference(2),
    "field strength": difference(0),
    "field dip": difference(1),
}


def rocs(walks: Sequence[GyroOffWalk], params: Params) -> list[Roc]:
    """Return how each sign tells turns in the second halves."""
    turning = np.concatenate([np.abs(walk.turns_rad[walk.half :]) > TURN_RAD for walk in walks])
    values = {IMPULSE: np.concatenate([told_rad(walk, params) for walk in walks])}
    values |= {name: np.concatenate([strangeness(walk, sign) for walk in walks]) for name, sign in SIGNS.items()}
    return [roc(name, turning, value) for name, value in values.items()]


def told_rad(walk: GyroOffWalk, params: Params) -> Floats:
    """Return the size of the turn that `TurnSuspicion` tells of each stride of the second half."""
    lesson = taught(walk, params)
    return np.array([abs(lesson.suspicion.turn(x).rad) for x in lesson.across_mps[walk.half :]])


def strangeness(walk: GyroOffWalk, sign: Sign) -> Floats:
    """Return how far a sign is from its usual value in each stride of the second half, in its usual deviations."""
    value = np.array([sign(*pair) for pair in zip(walk.stands, walk.stands[1:], strict=False)])
    first = value[: walk.half][np.abs(walk.turns_rad[: walk.half]) <= TURN_RAD]
    middle = np.median(first)
    return np.abs(value[walk.half :] - middle) / (np.median(np.abs(first - middle)) + 1e-12)


def roc(sign: str, turning: Flags, value: Floats) -> Roc:
    """Return how a value tells the strides that turn."""
    ranks, turns, straights = rankdata(value), int(turning.sum()), int((~turning).sum())
    area = (ranks[turning].sum() - turns * (turns + 1) / 2) / (turns * straights)
    limits = np.quantile(value[~turning], [1.0 - rate for rate in FALSE_ALARMS])
    detected = tuple(float(np.mean(value[turning] > limit)) for limit in limits)
    return Roc(sign, len(value), float(turning.mean()), float(area), detected)
