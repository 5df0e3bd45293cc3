"""One foot without an error-state filter: orientation from anywhere, the drift of each swing taken off (Qiu section 2).

A second method from judged samples to estimates and steps. It waits for the end of each swing, so it gives its
estimates in pieces; a step means the same as in the error-state filter, by the same text.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NO_STAMP, gravity_mps2
from pdr_core.eskf.configure import settings
from pdr_core.eskf.output import empty_nav
from pdr_core.eskf.state import fresh_state as fresh_steps
from pdr_core.eskf.step_events import step_taken
from pdr_core.params import Params
from pdr_core.pipeline.paces import accelerations, pace
from pdr_core.records import (
    NO_VERDICTS,
    AttitudeBlock,
    Flags,
    Floats,
    Level,
    NavBlock,
    Notice,
    Stamps,
    StanceBlock,
    StepEvent,
    joined,
    length,
    part,
)
from pdr_core.strapdown.dedrift import track
from pdr_core.strapdown.swing import Accelerations, Track, empty_track, fresh_state, leave_open

OPEN = "swings did not end in a stance, for a gap or the end of the recording: their drift is still in them"


class Held(NamedTuple):
    """Samples that wait for the end of their swing."""

    judged: StanceBlock
    attitude: AttitudeBlock
    whole: Flags  # (n,) the interval since the sample before can be integrated


class FreeOutput(NamedTuple):
    """What became known with a piece of the recording; all but `steps` have the same stamps."""

    judged: StanceBlock
    nav: NavBlock
    track: Track  # with the velocity before and after its drift was taken off (Qiu figure 7)
    steps: list[StepEvent]


def known_orientation(stamp_ns: Stamps, quat_xyzw: Floats) -> AttitudeBlock:
    """Return orientations, (n, 4), world from foot, of unit length, from anywhere: taken as certain, without bias."""
    n = len(quat_xyzw)
    return AttitudeBlock(stamp_ns, np.ascontiguousarray(quat_xyzw), np.zeros((n, 3, 3)), np.zeros((n, 3)))


NOTHING = Held(NO_VERDICTS, known_orientation(np.zeros(0, np.int64), np.zeros((0, 4))), np.zeros(0, np.bool_))


class FilterFree:
    """Judged samples with their orientations in, estimates and steps out, a swing later."""

    def __init__(self, params: Params) -> None:
        self._settings = settings(params.filter, params.place)._replace(level_ground=False)
        self._dedrift = params.dedrift
        self._gravity = gravity_mps2(np.radians(params.place.latitude_deg), params.place.height_m)
        self._drift, self._steps = fresh_state(), fresh_steps()
        self._steps.P[:] = np.diag(self._settings.initial_sd**2)
        self._waiting: Held | None = None
        self._last_ns, self._last_gyro_on = 0, False  # of what has been given out

    def run(self, judged: StanceBlock, attitude: AttitudeBlock) -> FreeOutput:
        """Return the estimates up to the last stance among these samples, and the steps certain with them."""
        waiting = 0
        if self._waiting:
            waiting = length(self._waiting.judged)
            judged, attitude = joined([self._waiting.judged, judged]), joined([self._waiting.attitude, attitude])
        held = Held(judged, attitude, self._whole(judged))
        found = empty_track(length(judged))
        done = track(self._accelerations(held), waiting, self._drift, found)
        self._waiting = part(held, done)
        return self._paced(part(held, 0, done), part(found, 0, done))

    def finish(self) -> FreeOutput:
        """Give out a swing that waits for its end, as it is, and the step that ends in the last stance."""
        held, self._waiting = self._waiting or NOTHING, None
        found = empty_track(length(held.judged))
        leave_open(self._accelerations(held), 0, length(held.judged), self._drift, found)
        out = self._paced(held, found)
        last = self._step() if self._steps.end_ns[1] != NO_STAMP else []
        return out._replace(steps=out.steps + last)

    def _accelerations(self, held: Held) -> Accelerations:
        steady, sd_mps = self._dedrift.drift == "steady", self._dedrift.stance_sd_mps
        return accelerations(*held, self._gravity, sd_mps, steady, self._settings)

    def _whole(self, judged: StanceBlock) -> Flags:
        """Return where the interval since the sample before can be integrated, (n,)."""
        step_ns = np.diff(judged.imu.stamp_ns, prepend=self._last_ns)
        on = judged.imu.gyro_sd_radps >= 0.0
        on_before = np.concatenate([[self._last_gyro_on], on])[:-1]
        return (step_ns > 0) & (step_ns <= GAP_NS) & on & on_before

    def _paced(self, held: Held, found: Track) -> FreeOutput:
        """Go through the samples that are done."""
        nav, steps, done = empty_nav(length(held.judged)), [], 0
        while done < length(held.judged):
            done, stance_is_over = pace(*held, found, done, self._settings, self._steps, nav)
            steps += self._step() if stance_is_over else []
        if done:
            self._last_ns = int(held.judged.imu.stamp_ns[-1])
            self._last_gyro_on = bool(held.judged.imu.gyro_sd_radps[-1] >= 0.0)
        return FreeOutput(held.judged, nav, found, steps)

    def _step(self) -> list[StepEvent]:
        step = step_taken(self._steps, self._settings, NO_STAMP)
        return [step] if step else []

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        count, first_ns = int(self._drift.open), int(self._drift.first_open_ns)
        return [Notice(Level.WARN, "swing_open", OPEN, count, first_ns)] if count else []
