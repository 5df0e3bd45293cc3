"""Hands a track from the filter to dead reckoning where the gyro goes off, and back where it is on again.

Off: the foot stood last where the filter says; the strides after it are reckoned. On: the filter levels the foot where
it stands, at the pose that was reckoned for that stand. So neither way has a jump.
"""

from collections import deque
from dataclasses import dataclass, field, replace
from math import hypot

import numpy as np

from pdr_core.conventions import GAP_NS, NO_STAMP, nanoseconds
from pdr_core.eskf import ZuptFilter
from pdr_core.eskf.output import empty_nav
from pdr_core.gait.dead_reckoning import GaitDeadReckoning, Length
from pdr_core.gait.stands import Stand
from pdr_core.heading import HeadingConstraint
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.runs import equal_runs
from pdr_core.params import Params, changed
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.pipeline.gait_model import GaitModel
from pdr_core.pipeline.gait_watch import SeenStride, Watched
from pdr_core.pipeline.recent_samples import RecentSamples
from pdr_core.pipeline.recent_track import RecentTrack, yaw_of
from pdr_core.pipeline.reckoned_health import reckoned_health
from pdr_core.records import (
    NO_VERDICTS,
    FilterHealth,
    Floats,
    Handover,
    HeadingObservation,
    HeadingSource,
    NavBlock,
    Notice,
    PoseEstimate,
    StanceBlock,
    StepEvent,
    length,
    part,
)
from pdr_core.records_gait import Behaviour, GaitStep
from pdr_core.records_power import MeasuredStride

FORGOTTEN_NS = nanoseconds(3.0)  # a stride and its measurement that have not met by then do not belong together
GATE = 3.0  # standard deviations of a heading by the field
SAME_NS = nanoseconds(0.2)  # no stride is so short: a ground hit so soon is that of the stand before it
QUIET_NS = nanoseconds(2.0)  # without a stride for so long, the foot is taken to stand
UNKNOWN_LENGTH = Length(float("nan"), 0.0)


@dataclass
class Navigated:
    """What became known with some samples."""

    outputs: list[FootOutput] = field(default_factory=list)
    measured: list[MeasuredStride] = field(default_factory=list)
    reckoned: int = 0


class AdaptiveNavigation:
    """Judged samples and the strides that the accelerometer shows in, one track out."""

    def __init__(self, params: Params) -> None:
        self._filter = ZuptFilter(changed(params, "filter", heading_feedback=False).filter, params.place)
        self._reckoning = GaitDeadReckoning(params.dead_reckoning)
        self._constraint = HeadingConstraint(params.heading)
        self._model = GaitModel(params)
        self._track = RecentTrack()
        self._samples = RecentSamples(params.filter.alignment_s)
        self._filtering = True
        self._was_off = False  # the gyro: the heading may have suffered
        self._seen: deque[SeenStride] = deque()  # that wait for their step
        self._steps: deque[StepEvent] = deque()  # that wait for their stride
        self._hit_ns = NO_STAMP  # the last ground hit that was reckoned, or where the filter ended
        self._ran: Stand | None = None  # where a runner's foot stood at that hit
        self._told_ns = NO_STAMP  # the last estimate that was given out
        self._newest_ns = NO_STAMP
        self._told_m: Floats = np.zeros(3)
        self._last: GaitStep | None = None
        self._count = 0  # steps
        self.turning = False  # the last stride has turned, or is suspected to have
        self.ready = False  # the model is good for strides like the last one

    def run(self, judged: StanceBlock, watched: Watched, share_about_up: Floats | None = None) -> Navigated:
        """Return what becomes known with the next samples and with strides known by them.

        `share_about_up` (n,): how much of the noise of their rates acts about the vertical; None: all of it.
        """
        out = Navigated()
        share = np.ones(length(judged)) if share_about_up is None else share_about_up
        self._follow_clock(judged)
        self._samples.add(judged, watched.still)
        for start, stop in alike(judged, share):
            self._filter.know_turn(float(share[start]))
            self._navigate(part(judged, start, stop), bool(judged.imu.gyro_sd_radps[start] >= 0.0), out)
        for stride in watched.strides:
            self._meet(stride, out)
        self._learn()
        if not self._filtering:
            self._return_to_filter(out)
        return out

    def doubt_heading(self) -> None:
        """Take the heading for one that the field may correct: the gyro has slept."""
        self._was_off = True

    @property
    def gyro_bias_radps(self) -> Floats:
        """The gyro bias (3,) that the filter knows."""
        return self._filter.state.gyro_bias_radps.copy()

    def forget_length(self) -> None:
        """Learn the length of strides like the last one anew."""
        if self._last:
            self._model.forget_length(self._last)

    def place(self, pose: PoseEstimate, keep_biases: bool) -> None:
        """Go on from a pose at which somebody says the foot stands; one without a quaternion keeps the attitude.

        A stride that has ended there and is told of later does not lead away from it.
        """
        now = (self._filter if self._filtering else self._reckoning).handover
        start = Handover(max(now.stamp_ns, self._newest_ns), pose, now.biases if keep_biases else None)
        if self._filtering:
            self._filter.reset(start)
        self._reckoning.begin(start)
        self._hit_ns = self._newest_ns
        self._track.forget()
        self._seen.clear()
        self._steps.clear()
        self._told_m, self._count = pose.position_m, 0
        if pose.quat_xyzw is not None:
            self._model.forget_north()

    def finish(self) -> Navigated:
        """Return what the end of the samples makes certain."""
        out = Navigated()
        if self._filtering:
            self._give_out(NO_VERDICTS, empty_nav(0), self._filter.finish(), out)
        elif self._newest_ns != NO_STAMP:
            self._reckoned(self._reckoning.stand(self._newest_ns), [], out)
        return out

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._filter.notices + self._reckoning.notices + self._constraint.notices

    @property
    def health(self) -> FilterHealth:
        """How far the estimate can be trusted now."""
        known = self._filter.health
        return known if self._filtering else reckoned_health(known, self._newest_ns, self._reckoning.handover.pose)

    def _navigate(self, piece: StanceBlock, measured: bool, out: Navigated) -> None:
        if self._filtering and not measured:
            self._leave_filter(out)
        if self._filtering:
            self._filtered(piece, out)

    def _filtered(self, judged: StanceBlock, out: Navigated) -> None:
        nav, steps = self._filter.run(judged)
        self._track.add(nav, judged.stance)
        self._give_out(judged, nav, steps, out)

    def _leave_filter(self, out: Navigated) -> None:
        """Go on by strides from where the foot stood last."""
        self._give_out(NO_VERDICTS, empty_nav(0), self._filter.finish(), out)
        self._filtering, self._was_off = False, True
        if stood := self._track.stood:
            self._hit_ns = stood[0]
            self._reckoning.begin(Handover(*stood, self._filter.handover.biases))

    def _return_to_filter(self, out: Navigated) -> None:
        """Let the filter go on where the foot stands at a pose that is known; until then it is reckoned or held."""
        level = self._samples.levelling(self._hit_ns)
        samples = self._samples.from_instant(self._ran) if level is None and self._ran else level
        if samples:
            self._filter.reset(self._reckoning.handover, at_once=level is None)
            self._track.forget()
            self._filtering = True
            self._filtered(samples, out)
        elif self._newest_ns - self._hit_ns > QUIET_NS:
            self._reckoned(self._reckoning.stand(self._newest_ns - QUIET_NS), [], out)

    def _meet(self, stride: SeenStride, out: Navigated) -> None:
        """Measure a stride, or reckon it."""
        self._last, self.ready = stride.step, self._model.ready(stride.step)
        if self._filtering or stride.step.stamp_ns <= self._hit_ns + SAME_NS:
            self._seen.append(stride)
            self._measure(stride, out)
            return
        told = self._model.told(stride)
        reckoned = self._reckoning.step(stride.step, told.length, told.turn, told.deviation, told.heading)
        self._hit_ns, self.turning = stride.step.stamp_ns, self._model.turns(stride)
        self._ran = stride.stand if stride.step.behaviour is Behaviour.RUNNING else None
        self._reckoned(reckoned.nav, [reckoned.step], out)
        out.reckoned += 1

    def _measure(self, stride: SeenStride, out: Navigated) -> None:
        """Compare a stride with the model, if the filter knows where the foot stood before and after it."""
        ends = self._ends(stride)
        if ends is None:
            return
        before, after = ends
        self.turning = self._model.turned(wrapped_rad(yaw_of(after).rad - yaw_of(before).rad))
        said = self._model.length(stride.step) if self.ready else UNKNOWN_LENGTH
        filter_m = float(np.linalg.norm((after.position_m - before.position_m)[:2]))
        start_ns, stamp_ns = stride.step.start_ns, stride.step.stamp_ns
        out.measured.append(MeasuredStride(start_ns, stamp_ns, filter_m, said.m, said.sd_m))
        if self._filtering and self._was_off:
            self._look_north(stride, after)

    def _look_north(self, stride: SeenStride, stood: PoseEstimate) -> None:
        """Correct the heading that the filter took over by the field, though not below what all places share."""
        heading, before = self._model.heading(stride), self._filter.handover.pose
        if heading is None or yaw_of(before).sd_rad <= heading.common_sd_rad:
            return
        error_rad = wrapped_rad(yaw_of(stood).rad - heading.rad)
        if abs(error_rad) <= GATE * hypot(yaw_of(before).sd_rad, heading.sd_rad):
            self._filter.take_heading(error_rad, heading.sd_rad)
            self._track.move(self._filter.handover.pose)

    def _learn(self) -> None:
        """Let the model learn from the strides whose step is certain."""
        while self._steps:
            step = self._steps[0]
            pairs = [s for s in self._seen if step.start_ns < s.step.stamp_ns <= step.stamp_ns]
            if not pairs and 0 <= self._newest_ns - step.stamp_ns < FORGOTTEN_NS:
                return
            self._steps.popleft()
            if len(pairs) == 1 and (ends := self._ends(pairs[0])):
                self._model.learn(pairs[0], step, yaw_of(ends[0]), yaw_of(ends[1]), north=not self._was_off)
            while self._seen and self._seen[0].step.stamp_ns <= step.stamp_ns:
                self._seen.popleft()

    def _ends(self, stride: SeenStride) -> tuple[PoseEstimate, PoseEstimate] | None:
        """Return the foot's pose where it stood before and after a stride; None: the filter has not seen both."""
        if stride.before is None or stride.stand is None:
            return None
        before, after = self._track.at(stride.before.stamp_ns), self._track.at(stride.stand.stamp_ns)
        return (before, after) if before and after else None

    def _reckoned(self, nav: NavBlock, steps: list[StepEvent], out: Navigated) -> None:
        """Give out estimates of dead reckoning, without a jump from the last one that was given out."""
        self._give_out(*self._samples.at(going_on(nav, self._told_ns, self._told_m)), steps, out)

    def _give_out(self, judged: StanceBlock, nav: NavBlock, steps: list[StepEvent], out: Navigated) -> None:
        """Give out estimates that are new, and steps with the next numbers."""
        numbered = [replace(step, index=self._count + i) for i, step in enumerate(steps, 1)]
        self._count += len(steps)
        if self._filtering:
            self._steps += numbered
        first = int(np.searchsorted(nav.stamp_ns, self._told_ns, side="right"))
        if first < length(nav):
            self._told_ns, self._told_m = int(nav.stamp_ns[-1]), nav.position_m[-1]
        out.outputs.append(FootOutput(part(judged, first), part(nav, first), numbered))
        for step in numbered:
            self._hold(self._constraint.answer(step))

    def _hold(self, told: HeadingObservation) -> None:
        """Turn the track back by what the heading constraint tells of it, whoever navigates."""
        if told.source is HeadingSource.NONE:
            return
        if self._filtering:
            self._filter.take_heading(told.yaw_error_rad, told.yaw_error_sd_rad)
            self._track.move(self._filter.handover.pose)
        else:
            self._reckoning.take_heading(told.yaw_error_rad, told.yaw_error_sd_rad)

    def _follow_clock(self, judged: StanceBlock) -> None:
        """Forget what was waited for before the clock jumped back."""
        stamps = judged.imu.stamp_ns
        if (np.diff(stamps, prepend=self._newest_ns if self._newest_ns != NO_STAMP else stamps[:1]) < 0).any():
            self._track.forget()
            self._seen.clear()
            self._steps.clear()
            self._hit_ns = self._told_ns = NO_STAMP
        self._newest_ns = int(stamps[-1]) if len(stamps) else self._newest_ns


def going_on(nav: NavBlock, told_ns: int, told_m: Floats) -> NavBlock:
    """Return the estimates after a stamp so that they begin where the foot was said to be then, and end where they do.

    The filter lost the foot in its swing, and what is reckoned between two stands is a straight and even way.
    """
    nav = part(nav, int(np.searchsorted(nav.stamp_ns, told_ns, side="right")))
    if told_ns == NO_STAMP or not length(nav):
        return nav
    start_ns = told_ns if nav.stamp_ns[0] - told_ns <= GAP_NS else nav.stamp_ns[0]
    left = (nav.stamp_ns[-1] - nav.stamp_ns) / max(nav.stamp_ns[-1] - start_ns, 1)
    return nav._replace(position_m=nav.position_m + left[:, None] * (told_m - nav.position_m[0]))


def alike(judged: StanceBlock, share_about_up: Floats) -> list[tuple[int, int]]:
    """Return the runs of samples, first and behind the last, in which the gyro is on or off, and the share the same."""
    kinds = np.where(judged.imu.gyro_sd_radps >= 0.0, share_about_up, -1.0)
    return equal_runs(kinds)
