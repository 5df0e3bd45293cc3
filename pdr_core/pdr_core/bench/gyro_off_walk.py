"""A walk whose second half has its gyro off: as the filter has it, as the accelerometer sees it, and as it was."""

from dataclasses import dataclass

import numpy as np

from pdr_core.bench.trial import Walk, outputs
from pdr_core.evaluation import alignment
from pdr_core.gait.stands import Stand, Stands
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import Params, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import Floats, ImuBlock, NavBlock, StepEvent, Truth, TruthKind, joined, part
from pdr_core.stance import StanceDetection

STILL_VARIANCE = 1.4  # of the acceleration, (m/s^2)^2: counts exact on the tile walks from 1.0 to 1.44
NO_STRIDES = "{}: stands, steps and true strides differ: {}, {}, {}"


class Unpaired(Exception):  # noqa: N818  (what a person meets)
    """Strides that do not belong together; the text says why."""


@dataclass(frozen=True)
class GyroOffWalk:
    """A walk as the filter with its gyro has it and as the accelerometer sees it: strides between stands."""

    name: str
    stands: list[Stand]
    nav: NavBlock  # at the stands
    steps: list[StepEvent]
    truth_m: Floats  # (strides + 1, 2) in the frame of the filter

    @property
    def half(self) -> int:
        """The stand from which the walk is dead reckoned."""
        return len(self.steps) // 2

    @property
    def yaws_rad(self) -> Floats:
        """The filter's yaw at the stands, (strides + 1,)."""
        return np.array([yaw_rad(q) for q in self.nav.quat_xyzw])

    @property
    def turns_rad(self) -> Floats:
        """The filter's turn in each stride, (strides,)."""
        return np.array([wrapped_rad(turn) for turn in np.diff(self.yaws_rad)])

    @property
    def lengths_m(self) -> Floats:
        """The true length of each stride, (strides,)."""
        return np.linalg.norm(np.diff(self.truth_m, axis=0), axis=1)


def seen(walk: Walk, params: Params) -> GyroOffWalk:
    """Run the filter with the gyro on, and the accelerometer alone; Unpaired where strides do not belong together."""
    told = list(outputs(FootInertial(params), walk.pieces))
    nav, steps = joined([o.nav for o in told]), [step for o in told for step in o.steps]
    stands = stood(joined([o.judged for o in told]).imu, params)
    at = np.searchsorted(nav.stamp_ns, [stand.stamp_ns for stand in stands])
    standing = joined([part(nav, i, i + 1) for i in at.tolist()])
    truth_m = true_places_m(walk.truth, standing)
    if not len(stands) == len(steps) + 1 == len(truth_m):
        raise Unpaired(NO_STRIDES.format(walk.name, len(stands) - 1, len(steps), len(truth_m) - 1))
    first = slice(0, len(steps) // 2 + 1)
    laid = alignment.over_whole(truth_m[first], standing.position_m[first, :2]).apply(truth_m)
    return GyroOffWalk(walk.name, stands, standing, steps, laid)


def stood(imu: ImuBlock, params: Params) -> list[Stand]:
    """Return the stands that the accelerometer alone shows."""
    off = imu._replace(gyro_radps=np.zeros_like(imu.gyro_radps), gyro_sd_radps=np.full(len(imu.stamp_ns), -1.0))
    told = changed(params, "stance", detector="acceleration_moving_variance")
    told = changed(told, "detectors", acceleration_moving_variance_threshold=STILL_VARIANCE)
    detection, stands = StanceDetection(told.stance, told.place, told.detectors), Stands(params.dead_reckoning)
    return stands.run(detection.run(off)) + stands.run(detection.finish()) + stands.finish()


def true_places_m(truth: Truth | None, standing: NavBlock) -> Floats:
    """Return where the foot stood, (stands, 2): a row of the truth each, or the truth at their stamps."""
    if truth is None or truth.kind is TruthKind.CLOSED_LOOP:
        return np.empty((0, 2))
    if truth.kind is TruthKind.STRIDES:
        return truth.position_m[:, :2]
    return np.column_stack([np.interp(standing.stamp_ns, truth.stamp_ns, truth.position_m[:, i]) for i in range(2)])
