"""A card on the chest: intake, Cheng's navigation, step length and heading constraint."""

import pickle
from dataclasses import replace
from typing import Self

import numpy as np

from pdr_core.chest import ChestEstimate, ChestNavigator
from pdr_core.conventions import STANDARD_GRAVITY_MPS2, stamp_ns_from_seconds
from pdr_core.heading import HeadingConstraint
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.pipeline.chest_compass import ChestCompass
from pdr_core.pipeline.chest_reference import StepReference
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.records import (
    FieldUse,
    FilterHealth,
    HeadingSource,
    ImuBlock,
    Notice,
    PoseEstimate,
    StanceBlock,
    StepEvent,
    inertial_block,
    length,
)


class ChestCard:
    """Samples in, estimates and steps out. A step is one of the body, not of a foot; its stance is a rest."""

    def __init__(self, params: Params) -> None:
        self._intake = Ingestion(params.intake)
        self._reference = StepReference(params.chest, params.gait)
        self._chest = ChestNavigator(params.chest, params.place, self._reference)
        self._params = params
        self._begin_track(0.0)

    def _begin_track(self, yaw_sd_rad: float) -> None:
        """Know nothing of where straight lines go and the field points, in the frame of a track."""
        self._constraint = HeadingConstraint(self._params.heading)
        self._compass = ChestCompass(self._params, yaw_sd_rad)

    def run(self, raw: ImuBlock) -> FootOutput:
        """Take the next samples, any number of them."""
        return self._estimated(self._intake.run(raw))

    def finish(self) -> FootOutput:
        """Give out what still waits for later samples: there will be none."""
        return self._estimated(self._intake.finish())

    def _estimated(self, imu: ImuBlock) -> FootOutput:
        self._compass.add(imu)
        estimate = self._chest.run(imu, self._constrain)
        self._compass.forget()
        return FootOutput(resting(imu, estimate), estimate.nav, estimate.steps)

    def _constrain(self, step: StepEvent) -> None:
        """Let the field and the heading constraint turn the track."""
        if error := self._compass.yaw_error(step, self._chest.state.level_axes):
            self._chest.turn_back(error.rad, error.sd_rad)
        answer = self._constraint.answer(step)
        if answer.source is not HeadingSource.NONE:
            self._chest.turn_back(answer.yaw_error_rad, answer.yaw_error_sd_rad)

    def place(self, pose: PoseEstimate, keep_biases: bool = True) -> None:
        """Go on from a pose in the world frame that somebody knows; its yaw is where the chest points."""
        self._chest.place(pose, keep_biases)
        self._begin_track(float(self._chest.state.yaw_sd_rad))

    def warm_up(self) -> None:
        """Compile everything, or load it from the cache, by a stand and a bounce: enough for a step."""
        time_s = np.arange(500) * 0.01
        bounce = np.where(time_s > 2.0, 3.0 * np.sin(4.0 * np.pi * time_s), 0.0)
        force = np.column_stack([0.0 * time_s, 0.0 * time_s, STANDARD_GRAVITY_MPS2 + bounce])
        rate = np.where(time_s > 2.0, 0.2, 0.0)[:, None] * [1.0, 0.0, 0.0]
        noise = np.zeros(len(time_s))
        self.run(inertial_block(stamp_ns_from_seconds(time_s), rate, force, noise, noise))
        self._chest.turn_back(0.0, 1.0)

    def saved(self) -> bytes:
        """Return everything that is remembered; `restored` goes on from there."""
        return pickle.dumps(self)

    @classmethod
    def restored(cls, memory: bytes) -> Self:
        """Return the card that `saved` remembered; give it nothing that somebody else has written."""
        card = pickle.loads(memory)
        if not isinstance(card, cls):
            raise TypeError("this is not the memory of a chest card")
        return card

    @property
    def health(self) -> FilterHealth:
        """How far the estimate can be trusted now."""
        use = FieldUse.HEADING if self._compass.told else FieldUse.NONE
        return replace(self._chest.health, field_use=use)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far, and what the constraint has done."""
        return self._intake.notices + self._chest.notices + self._constraint.notices


def resting(imu: ImuBlock, estimate: ChestEstimate) -> StanceBlock:
    """Return the samples with whether the chest rests, in place of the verdict on a foot."""
    n = length(imu)
    zero = np.zeros(n)
    return StanceBlock(imu, estimate.resting, zero, zero, zero, np.zeros((n, 3)), zero)
