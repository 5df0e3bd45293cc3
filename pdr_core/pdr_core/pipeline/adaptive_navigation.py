"""Navigates by the filter where the gyro is on, and by strides where it is off, and says when one follows the other."""

from dataclasses import dataclass, field
from math import hypot

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.eskf.output import empty_nav
from pdr_core.gait.dead_reckoning import Length
from pdr_core.gait.stands import Stand
from pdr_core.heading import HeadingConstraint
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.runs import equal_runs
from pdr_core.params import Params
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.pipeline.gait_model import GaitModel
from pdr_core.pipeline.gait_watch import SeenStride, Watched
from pdr_core.pipeline.navigators import Navigators
from pdr_core.pipeline.recent_samples import RecentSamples
from pdr_core.pipeline.recent_track import yaw_of
from pdr_core.pipeline.stride_lessons import StrideLessons
from pdr_core.pipeline.track_out import TrackOut
from pdr_core.records import (
    NO_VERDICTS,
    FilterHealth,
    Floats,
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
        self._navigators = Navigators(params)
        self._constraint = HeadingConstraint(params.heading)
        self._model = GaitModel(params)
        self._lessons = StrideLessons(self._model, self._navigators.track)
        self._samples = RecentSamples(params.filter.alignment_s)
        self._out = TrackOut()
        self._was_off = False  # the gyro: the heading may have suffered
        self._hit_ns = NO_STAMP  # the last ground hit that was reckoned, or where the filter ended
        self._ran: Stand | None = None  # where a runner's foot stood at that hit
        self._newest_ns = NO_STAMP
        self._last: GaitStep | None = None
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
            self._navigators.know_turn(float(share[start]))
            self._navigate(part(judged, start, stop), bool(judged.imu.gyro_sd_radps[start] >= 0.0), out)
        for stride in watched.strides:
            self._meet(stride, out)
        self._lessons.learn(self._newest_ns, north=not self._was_off)
        if not self._navigators.filtering:
            self._return_to_filter(out)
        return out

    def doubt_heading(self) -> None:
        """Take the heading for one that the field may correct: the gyro has slept."""
        self._was_off = True

    @property
    def gyro_bias_radps(self) -> Floats:
        """The gyro bias (3,) that the filter knows."""
        return self._navigators.gyro_bias_radps

    def forget_length(self) -> None:
        """Learn the length of strides like the last one anew."""
        if self._last:
            self._model.forget_length(self._last)

    def place(self, pose: PoseEstimate, keep_biases: bool) -> None:
        """Go on from a pose at which somebody says the foot stands; one without a quaternion keeps the attitude.

        A stride that has ended there and is told of later does not lead away from it.
        """
        self._navigators.place(self._newest_ns, pose, keep_biases)
        self._hit_ns = self._newest_ns
        self._lessons.forget()
        self._out.begin(pose.position_m)
        if pose.quat_xyzw is not None:
            self._model.forget_north()

    def finish(self) -> Navigated:
        """Return what the end of the samples makes certain."""
        out = Navigated()
        if self._navigators.filtering:
            self._give_out(NO_VERDICTS, empty_nav(0), self._navigators.finish_filter(), out)
        elif self._newest_ns != NO_STAMP:
            self._reckoned(self._navigators.reckoning.stand(self._newest_ns), [], out)
        return out

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._navigators.notices + self._constraint.notices

    @property
    def health(self) -> FilterHealth:
        """How far the estimate can be trusted now."""
        return self._navigators.health(self._newest_ns)

    def _navigate(self, piece: StanceBlock, measured: bool, out: Navigated) -> None:
        if self._navigators.filtering and not measured:
            self._leave_filter(out)
        if self._navigators.filtering:
            self._give_out(piece, *self._navigators.filtered(piece), out)

    def _leave_filter(self, out: Navigated) -> None:
        """Go on by strides from where the foot stood last."""
        self._give_out(NO_VERDICTS, empty_nav(0), self._navigators.finish_filter(), out)
        self._was_off = True
        stood_ns = self._navigators.leave_filter()
        self._hit_ns = self._hit_ns if stood_ns is None else stood_ns

    def _return_to_filter(self, out: Navigated) -> None:
        """Let the filter go on where the foot stands at a pose that is known; until then it is reckoned or held."""
        level = self._samples.levelling(self._hit_ns)
        samples = self._samples.from_instant(self._ran) if level is None and self._ran else level
        if samples:
            self._navigators.return_to_filter(at_once=level is None)
            self._give_out(samples, *self._navigators.filtered(samples), out)
        elif self._newest_ns - self._hit_ns > QUIET_NS:
            self._reckoned(self._navigators.reckoning.stand(self._newest_ns - QUIET_NS), [], out)

    def _meet(self, stride: SeenStride, out: Navigated) -> None:
        """Measure a stride, or reckon it."""
        self._last, self.ready = stride.step, self._model.ready(stride.step)
        if self._navigators.filtering or stride.step.stamp_ns <= self._hit_ns + SAME_NS:
            self._lessons.see(stride)
            self._measure(stride, out)
            return
        told = self._model.told(stride)
        reckoned = self._navigators.reckoning.step(stride.step, told.length, told.turn, told.deviation, told.heading)
        self._hit_ns, self.turning = stride.step.stamp_ns, self._model.turns(stride)
        self._ran = stride.stand if stride.step.behaviour is Behaviour.RUNNING else None
        self._reckoned(reckoned.nav, [reckoned.step], out)
        out.reckoned += 1

    def _measure(self, stride: SeenStride, out: Navigated) -> None:
        """Compare a stride with the model, if the filter knows where the foot stood before and after it."""
        ends = self._navigators.track.ends(stride)
        if ends is None:
            return
        before, after = ends
        self.turning = self._model.turned(wrapped_rad(yaw_of(after).rad - yaw_of(before).rad))
        said = self._model.length(stride.step) if self.ready else UNKNOWN_LENGTH
        filter_m = float(np.linalg.norm((after.position_m - before.position_m)[:2]))
        start_ns, stamp_ns = stride.step.start_ns, stride.step.stamp_ns
        out.measured.append(MeasuredStride(start_ns, stamp_ns, filter_m, said.m, said.sd_m))
        if self._navigators.filtering and self._was_off:
            self._look_north(stride, after)

    def _look_north(self, stride: SeenStride, stood: PoseEstimate) -> None:
        """Correct the heading that the filter took over by the field, though not below what all places share."""
        heading, before = self._model.heading(stride), self._navigators.handover.pose
        if heading is None or yaw_of(before).sd_rad <= heading.common_sd_rad:
            return
        error_rad = wrapped_rad(yaw_of(stood).rad - heading.rad)
        if abs(error_rad) <= GATE * hypot(yaw_of(before).sd_rad, heading.sd_rad):
            self._navigators.take_heading(error_rad, heading.sd_rad)

    def _reckoned(self, nav: NavBlock, steps: list[StepEvent], out: Navigated) -> None:
        """Give out estimates of dead reckoning, without a jump from the last one that was given out."""
        self._give_out(*self._samples.at(self._out.going_on(nav)), steps, out)

    def _give_out(self, judged: StanceBlock, nav: NavBlock, steps: list[StepEvent], out: Navigated) -> None:
        """Give out estimates that are new, and steps with the next numbers."""
        given = self._out.given(judged, nav, steps)
        if self._navigators.filtering:
            self._lessons.take(given.steps)
        out.outputs.append(given)
        for step in given.steps:
            told = self._constraint.answer(step)
            if told.source is not HeadingSource.NONE:
                self._navigators.take_heading(told.yaw_error_rad, told.yaw_error_sd_rad)

    def _follow_clock(self, judged: StanceBlock) -> None:
        """Forget what was waited for before the clock jumped back."""
        stamps = judged.imu.stamp_ns
        if (np.diff(stamps, prepend=self._newest_ns if self._newest_ns != NO_STAMP else stamps[:1]) < 0).any():
            self._navigators.track.forget()
            self._lessons.forget()
            self._out.forget_clock()
            self._hit_ns = NO_STAMP
        self._newest_ns = int(stamps[-1]) if len(stamps) else self._newest_ns


def alike(judged: StanceBlock, share_about_up: Floats) -> list[tuple[int, int]]:
    """Return the runs of samples, first and behind the last, in which the gyro is on or off, and the share the same."""
    kinds = np.where(judged.imu.gyro_sd_radps >= 0.0, share_about_up, -1.0)
    return equal_runs(kinds)
