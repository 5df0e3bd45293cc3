"""Steps as a filter tells of them, and a walk whose filter is as simple as can be: the yaw error alone."""

import numpy as np

from pdr_core.heading import HeadingConstraint
from pdr_core.params import HeadingParams
from pdr_core.records import HeadingObservation, HeadingSource, StepEvent

SECOND_NS = 1_000_000_000


def step(index: int, heading_rad: float, yaw_sd_rad: float = 0.02, length_m: float = 1.3, **more) -> StepEvent:
    """Return a step that takes a second."""
    end_ns = index * SECOND_NS
    displacement_m = length_m * np.array([np.cos(heading_rad), np.sin(heading_rad), 0.0])
    known = {"index": index, "start_ns": end_ns - SECOND_NS, "stamp_ns": end_ns, "displacement_m": displacement_m}
    other = {"position_m": np.zeros(3), "displacement_covariance_m2": 1e-4 * np.eye(3), "yaw_rad": heading_rad}
    due = {"yaw_sd_rad": yaw_sd_rad, "answer_due_ns": end_ns + SECOND_NS // 2}
    return StepEvent(**{**known, **other, **due, **more})


def constraint(name: str, **values) -> HeadingConstraint:
    """Return a constraint with some parameters changed."""
    return HeadingConstraint(HeadingParams(constraint=name, **values))


def answers(
    stage: HeadingConstraint, headings_rad, yaw_sd_rad: float = 0.02, first: int = 1
) -> list[HeadingObservation]:
    """Return what a constraint says of steps in these directions."""
    return [stage.answer(step(first + i, h, yaw_sd_rad)) for i, h in enumerate(headings_rad)]


def said(found: list[HeadingObservation]) -> list[int]:
    """Return the indices of the steps of which something was said."""
    return [answer.step_index for answer in found if answer.source is not HeadingSource.NONE]


class YawFilter:
    """A Kalman filter of the yaw error alone, which grows by a random walk from step to step."""

    def __init__(self, sd_rad: float, walk_rad: float, error_rad: float) -> None:
        self.variance_rad2, self.walk_rad, self.error_rad = sd_rad**2, walk_rad, error_rad

    def go_on(self, drift_rad: float) -> None:
        """Let a step pass in which the track turns by `drift_rad`, of which the filter knows the deviation."""
        self.error_rad += drift_rad
        self.variance_rad2 += self.walk_rad**2

    def take(self, error_rad: float, sd_rad: float) -> None:
        """Take what it is told, as the filter of the suite does."""
        gain = self.variance_rad2 / (self.variance_rad2 + sd_rad**2)
        self.error_rad -= gain * error_rad
        self.variance_rad2 *= 1.0 - gain
