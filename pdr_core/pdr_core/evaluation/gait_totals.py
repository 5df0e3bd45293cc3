"""A walk in the figures of gait analysis, added up over its strides."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from pdr_core.records_gait import Mounting, Stride

STAIR_M = 0.08  # a stride that ends so much higher or lower than it began is on stairs: half a riser
FLOOR_M = 3.0  # from one floor to the next


@dataclass(frozen=True)
class Spread:
    """Mean and standard deviation of a figure over the strides that have it; NaN where none has."""

    mean: float
    sd: float


@dataclass(frozen=True)
class GaitTotals:
    """What the strides of a walk amount to; NaN: unknown."""

    strides: int
    length_m: Spread
    duration_s: Spread
    cadence_per_min: Spread
    speed_mps: Spread
    stance_s: Spread
    swing_s: Spread
    clearance_m: Spread
    clearance_max_m: float
    pitch_max_rad: Spread
    pitch_min_rad: Spread
    turned_rad: float  # all turns of the foot added up, left is positive
    climbed_m: float  # on stairs, upwards
    descended_m: float
    floors_up: int
    floors_down: int
    riser_m: float  # height of one step of the stairs: a foot takes two in a stride
    mounting: Mounting | None

    def to_mapping(self) -> dict[str, Any]:
        """Return the totals as nested mappings."""
        return asdict(self)


def gait_totals(strides: Sequence[Stride], mounting: Mounting | None) -> GaitTotals:
    """Return the totals of a walk."""
    climbs_m = np.array([stride.step.displacement_m[2] for stride in strides])
    up_m, down_m = climbs_m[climbs_m > STAIR_M], -climbs_m[climbs_m < -STAIR_M]
    stairs_m = np.concatenate([up_m, down_m])
    clearances_m = [stride.clearance_m for stride in strides if stride.clearance_m is not None]
    return GaitTotals(
        strides=len(strides),
        length_m=spread(stride.step.length_m for stride in strides),
        duration_s=spread(stride.duration_s for stride in strides),
        cadence_per_min=spread(stride.cadence_per_min for stride in strides),
        speed_mps=spread(stride.speed_mps for stride in strides),
        stance_s=spread(stride.stance_s for stride in strides),
        swing_s=spread(stride.swing_s for stride in strides),
        clearance_m=spread(clearances_m),
        clearance_max_m=max(clearances_m, default=math.nan),
        pitch_max_rad=spread(stride.pitch_max_rad for stride in strides),
        pitch_min_rad=spread(stride.pitch_min_rad for stride in strides),
        turned_rad=math.fsum(stride.turn_rad or 0.0 for stride in strides),
        climbed_m=float(up_m.sum()),
        descended_m=float(down_m.sum()),
        floors_up=round(float(up_m.sum()) / FLOOR_M),
        floors_down=round(float(down_m.sum()) / FLOOR_M),
        riser_m=float(stairs_m.mean()) / 2.0 if len(stairs_m) else math.nan,
        mounting=mounting,
    )


def spread(values: Iterable[float | None]) -> Spread:
    """Return mean and standard deviation of the values that are known."""
    known = [value for value in values if value is not None]
    sd = float(np.std(known, ddof=1)) if len(known) > 1 else math.nan
    return Spread(float(np.mean(known)) if known else math.nan, sd)
