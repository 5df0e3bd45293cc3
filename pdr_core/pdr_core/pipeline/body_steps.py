"""The steps of a body as strides for the files of a run: what only a foot has is unknown."""

from dataclasses import fields, replace
from math import atan2

from pdr_core.maths.circular import wrapped_rad
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.records import Notice, StepEvent
from pdr_core.records_gait import Stride


class BodySteps:
    """Does for a card on the chest what `FootGait` does for a foot."""

    def __init__(self) -> None:
        self._before: StepEvent | None = None

    def run(self, output: FootOutput) -> list[Stride]:
        """Return the steps of this output."""
        return [self._step(step) for step in output.steps]

    def finish(self) -> list[Stride]:
        """Return none: no step waits."""
        return []

    @property
    def notices(self) -> list[Notice]:
        """Nothing."""
        return []

    def _step(self, step: StepEvent) -> Stride:
        before, self._before = self._before, step
        if before is None:
            return unknown(step)
        turn_rad = wrapped_rad(step.yaw_rad - before.yaw_rad)
        change_rad = wrapped_rad(way_rad(step) - way_rad(before))
        return replace(unknown(step), turn_rad=turn_rad, heading_change_rad=change_rad)


def unknown(step: StepEvent) -> Stride:
    """Return a step of which nothing is known but where it went."""
    return Stride(step, *[None] * (len(fields(Stride)) - 1))


def way_rad(step: StepEvent) -> float:
    """Return the direction in which a step went, counter-clockwise from x of the world."""
    return atan2(step.displacement_m[1], step.displacement_m[0])
