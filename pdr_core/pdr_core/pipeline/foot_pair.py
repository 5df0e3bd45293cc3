"""What one foot or two tell together: answers to their steps, frames of their worlds, and which is the left one."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from pdr_core.fusion.body import YAW, Frame, Gait, Moved
from pdr_core.fusion.foot_rows import LOST_YAW_RAD2
from pdr_core.fusion.frames import FootFrames
from pdr_core.fusion.separation import Reach, place_error
from pdr_core.fusion.sides import Sides
from pdr_core.maths.circular import wrapped_rad
from pdr_core.notices import Tally
from pdr_core.params import Params
from pdr_core.pipeline.step_answers import StepAnswers
from pdr_core.records import Floats, HeadingObservation, Level, Notice, PositionError, StepEvent
from pdr_core.records_external import about_up

SWAPPED = "the sensors seem to be swapped: in turns the foot that is called the right one goes as the left one does"
MOUNTING = "the feet walk in directions that differ by {:.0f} deg: calibrate both mountings by `pdr calibrate mounting`"
APART = "the tracks of the feet were farther apart than legs reach"

Places = Callable[[tuple[Frame, Frame]], list[Moved | None]]  # of the feet, with these frames; None: not known


class FootPair:
    """Takes the steps of one foot, or of a left and a right one, in order."""

    def __init__(self, params: Params, feet: Sequence[str]) -> None:
        p = params.fusion
        self._params = p
        self._two = len(feet) == 2
        self._answers = StepAnswers(params, feet)
        self._frames = FootFrames(p, feet)
        self._sides = Sides(feet) if self._two else None
        self._reach = Reach(p.separation_max_m, p.separation_height_max_m, p.separation_sd_m)
        self._feet = tuple(feet)
        self.gait = Gait(p.stance_width_m if self._two else 0.0, p.apart_sd_m)
        self._tally = Tally()

    def begin(self, foot: str, start_m: Floats) -> None:
        """Take it that a foot's filter has the foot here at the start."""
        self._frames.begin(foot, start_m)

    def begin_anew(self, foot: str, step: StepEvent, places: Places) -> bool:
        """Find a foot that is lost, or in another world, by its next step; return whether the other knows better."""
        other = next(
            (at for name, at in zip(self._feet, places(self.frames), strict=True) if at and name != foot), None
        )
        if other is None or other.pose_covariance[YAW, YAW] > max(LOST_YAW_RAD2, 0.25 * step.yaw_sd_rad**2):
            return False
        frames = {name: self.frame(name) for name in self._feet}
        self._answers.begin(foot)
        self._frames.turn_rad |= {name: frame.yaw_rad for name, frame in frames.items()}
        self._frames.begin_anew(foot, step, other, frames[foot].toe_rad)
        return True

    def answer(self, foot: str, step: StepEvent, places: Places) -> HeadingObservation:
        """Return the answer to a step of a foot; `places` gives those of both feet as it ends."""
        answer = self._answers.answer(foot, turned(step, self._frames.turn_rad[foot]))
        if not self._two or not self._sides:
            return answer
        self._sides.take(foot, step)
        if self._sides.swapped:
            self._tally.add("feet_swapped", Level.WARN, SWAPPED, step.stamp_ns)
        self._check_mounting(step.stamp_ns)
        return replace(answer, position=self._place_error(foot, step, places))

    def _check_mounting(self, stamp_ns: int) -> None:
        turns = [known.turn_rad for foot in self._feet if (known := self._answers.dual.known(foot))]
        if len(turns) == 2 and abs(apart_rad := wrapped_rad(turns[0] - turns[1])) > self._params.mounting_apart_rad:
            text = MOUNTING.format(np.degrees(abs(apart_rad)))
            self._tally.add("mounting_apart", Level.WARN, text, stamp_ns)

    def _place_error(self, foot: str, step: StepEvent, places: Places) -> PositionError | None:
        """Return by how much a foot is off that is farther from the other than legs reach; in its own world."""
        if not self._answers.dual.aligned:
            return None
        one, other = places(self.frames) if foot == self._feet[0] else reversed(places(self.frames))
        if one is None or other is None:
            return None
        apart_m, at = one.pose[:YAW] - other.pose[:YAW], np.s_[:YAW, :YAW]
        error = place_error(apart_m, with_halved(one)[at], with_halved(other)[at], self._reach)
        if error is None:
            return None
        self._tally.add("feet_apart", Level.WARN, APART, step.stamp_ns)
        R = about_up(-self.frame(foot).yaw_rad)
        return PositionError(R @ error.error_m, R @ error.covariance_m2 @ R.T)

    @property
    def frames(self) -> tuple[Frame, Frame]:
        """Where the worlds of the feet lie in that of the body, as known now."""
        return self.frame(self._feet[0]), self.frame(self._feet[-1])

    def frame(self, foot: str) -> Frame:
        """Return where the world of a foot lies in that of the body, as known now."""
        return self._frames.of(foot, self._answers.dual.known(foot))

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._answers.notices + self._tally.notices


def turned(step: StepEvent, angle_rad: float) -> StepEvent:
    """Return a step in a world that is turned by an angle about z."""
    R = about_up(angle_rad)
    covariance_m2 = R @ step.displacement_covariance_m2 @ R.T
    yaw_rad, displacement_m = step.yaw_rad + angle_rad, R @ step.displacement_m
    return (
        replace(step, displacement_m=displacement_m, displacement_covariance_m2=covariance_m2, yaw_rad=yaw_rad)
        if angle_rad
        else step
    )


def with_halved(foot: Moved) -> Floats:
    """Return the covariance (4, 4) of the pose of a foot by itself."""
    return foot.pose_covariance + np.outer(foot.halved, foot.halved)
