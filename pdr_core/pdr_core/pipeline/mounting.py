"""Installation alignment of a whole recording: how the sensor sits on the foot, found by running the chain."""

import json
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from pdr_core.conventions import nanoseconds
from pdr_core.gait import foot_events
from pdr_core.gait.initial_orientation import aligned, euler_rad, walking_frame, walking_yaw_rad
from pdr_core.gait.installation import Installation
from pdr_core.gait.samples import Buffer
from pdr_core.maths.quaternion import from_euler, matrix
from pdr_core.params import IntakeParams, Params
from pdr_core.pipeline.foot_inertial import FootInertial, FootOutput
from pdr_core.records import Floats, ImuBlock, Stamps, StepEvent, joined, part
from pdr_core.records_gait import Mounting

SHOWN_S = 20.0  # of the recording, from its start
REST_S = 3.0  # before the first stride, at most


@dataclass(frozen=True)
class FoundMounting:
    """How the sensor sits, and the orientations that show it; `before` and `after` in Qiu's frame, x ahead."""

    mounting: Mounting  # body from foot: beyond what the parameters had said already
    angles_rad: tuple[float, float, float]  # roll, pitch, yaw for the intake: body from sensor
    walking_yaw_rad: float | None  # at the start, counter-clockwise from magnetic east; None: no magnetometer
    stamp_ns: Stamps  # (n,)
    before_xyzw: Floats  # (n, 4) world from foot
    after_xyzw: Floats  # (n, 4) world from body
    rest: slice  # the rows of the rest before the first stride

    def to_json(self) -> str:
        """Return what the walk tells of the mounting as JSON."""
        names = ("mounting_roll_rad", "mounting_pitch_rad", "mounting_yaw_rad")
        content: dict[str, float | None] = dict(zip(names, self.angles_rad, strict=True))
        content |= {"tilt_sd_rad": self.mounting.tilt_sd_rad, "yaw_sd_rad": self.mounting.yaw_sd_rad}
        content |= {"strides": self.mounting.strides, "walking_yaw_rad": self.walking_yaw_rad}
        return json.dumps(content, indent=2, allow_nan=False)


class MountingSearch:
    """Takes a recording piece by piece."""

    def __init__(self, params: Params) -> None:
        self._params = params
        self._chain = FootInertial(params)
        self._buffer = Buffer()
        self._installation = Installation()
        self._begin: list[FootOutput] = []  # what is shown
        self._shown_until_ns: int | None = None
        self._steps: list[StepEvent] = []

    def run(self, pieces: Iterable[ImuBlock]) -> FoundMounting | str:
        """Return the mounting, or why it cannot be told."""
        for piece in pieces:
            self._take(self._chain.run(piece))
        self._take(self._chain.finish())
        mounting = self._installation.found()
        return self._found(mounting) if mounting else self._installation.doubt()

    def _take(self, output: FootOutput) -> None:
        if len(output.nav.stamp_ns) and self._shown_until_ns is None:
            self._shown_until_ns = int(output.nav.stamp_ns[0]) + nanoseconds(SHOWN_S)
        if len(output.nav.stamp_ns) and output.nav.stamp_ns[0] <= (self._shown_until_ns or 0):
            self._begin.append(output)
        self._buffer.add(output.judged, output.nav)
        for step in output.steps:
            cycle = self._buffer.take(step)
            self._installation.add(cycle, foot_events.marks(cycle))
        self._steps += output.steps
        self._buffer.forget()

    def _found(self, mounting: Mounting) -> FoundMounting:
        nav, imu = joined([o.nav for o in self._begin]), joined([o.judged.imu for o in self._begin])
        shown = slice(0, int(np.searchsorted(nav.stamp_ns, self._shown_until_ns or 0)))
        stop = int(np.searchsorted(nav.stamp_ns, self._steps[0].start_ns))
        start = int(np.searchsorted(nav.stamp_ns, self._steps[0].start_ns - nanoseconds(REST_S)))
        rest = slice(start, max(start + 1, stop))
        ahead = matrix(nav.quat_xyzw[rest.start]) @ matrix(mounting.quat_xyzw)[0]
        before = walking_frame(nav.quat_xyzw[shown], float(np.arctan2(ahead[1], ahead[0])))
        return FoundMounting(
            mounting,
            euler_rad(matrix(mounting.quat_xyzw) @ foot_from_sensor(self._params.intake)),
            yaw_at(part(imu, rest.start, rest.stop), mounting),
            nav.stamp_ns[shown],
            before,
            aligned(before, mounting),
            rest,
        )


def foot_from_sensor(intake: IntakeParams) -> Floats:
    """Return the rotation that the intake applies, (3, 3)."""
    angles_rad = (intake.mounting_roll_rad, intake.mounting_pitch_rad, intake.mounting_yaw_rad)
    return matrix(from_euler(*angles_rad))


def yaw_at(rest: ImuBlock, mounting: Mounting) -> float | None:
    """Return the yaw of the walking direction at a rest, from magnetic east; None without a field."""
    known = rest.field_sd_tesla >= 0.0
    if not known.any():
        return None
    return walking_yaw_rad(mounting, rest.accel_mps2.mean(axis=0), rest.field_tesla[known].mean(axis=0))
