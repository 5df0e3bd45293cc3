"""The chest card: samples in; estimates, and a step at each footfall, out."""

from collections.abc import Callable
from math import atan2, cos, hypot, sin
from typing import Any, NamedTuple

import numpy as np

from pdr_core.chest.health import judged, notices
from pdr_core.chest.navigate import navigate
from pdr_core.chest.output import empty_nav, write
from pdr_core.chest.placing import forget_bias, place, turn_track
from pdr_core.chest.settings import Settings, settings
from pdr_core.chest.state import BUCKETS, LAYOUT, ChestState, fresh_state, state_of
from pdr_core.chest.step_length import compensate, keep_level
from pdr_core.chest.steps import LARGEST, LEAST, MAGNITUDES, SAMPLES, SUM, begin_step, hand_on
from pdr_core.chest.stride import correct_attitude
from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.params import ChestParams, PlaceParams
from pdr_core.records import FilterHealth, Flags, ImuBlock, NavBlock, Notice, PoseEstimate, StepEvent, length


class ChestStep(NamedTuple):
    """What is known of a step when it ends, before its length is compensated."""

    start_ns: int
    stamp_ns: int
    uniform: bool
    speed_known: bool  # False: the walk began unseen, or with a tilt that was lost
    since_rest: int  # steps of this walk before it
    moved_m: tuple[float, float]  # as solved, ahead of the chest and left of it: its length is L' of eq. 13
    figures: tuple[float, float, float, float]  # of |f| - g: mean, largest, least, mean of magnitudes [m/s^2]

    @property
    def length_m(self) -> float:
        """L' of eq. 13."""
        return hypot(*self.moved_m)

    @property
    def duration_s(self) -> float:
        """How long it took."""
        return (self.stamp_ns - self.start_ns) / NANOSECONDS


class Wanted(NamedTuple):
    """What a step should be, and by how much of the difference it is to be moved there."""

    ahead_m: float  # of the chest
    left_m: float
    share: float


class ChestEstimate(NamedTuple):
    """What some samples have shown."""

    nav: NavBlock
    steps: list[StepEvent]
    resting: Flags  # (n,)


Compare = Callable[[ChestStep], Wanted | None]


def nothing(_: ChestStep) -> Wanted | None:
    """Say nothing of a step's length."""
    return None


class ChestNavigator:
    """Cheng's navigation; `compare` says what the length of each step should be (eq. 13)."""

    def __init__(self, params: ChestParams, place: PlaceParams, compare: Compare = nothing) -> None:
        self._settings: Settings = settings(params, place, BUCKETS)
        self._compare = compare
        self.state: ChestState = fresh_state()

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"state": np.array([self.state], LAYOUT)}

    def __setstate__(self, remembered: dict[str, Any]) -> None:
        self.__dict__ |= remembered | {
            "state": state_of(remembered["state"])
        }  # what is written to an unpickled record is lost

    def run(self, block: ImuBlock, heard: Callable[[StepEvent], object] = bool) -> ChestEstimate:
        """Return an estimate of each sample, and the steps that end in them; `heard` is told of each as it ends."""
        nav, resting = empty_nav(length(block)), np.zeros(length(block), np.bool_)
        steps: list[StepEvent] = []
        done = 0
        while done < length(block):
            done, ended = navigate(block, done, self._settings, self.state, nav, resting)
            if ended:
                steps.append(self._step_taken(int(block.stamp_ns[done])))
                heard(steps[-1])
                write(nav, done, self._settings, self.state)
                done += 1
        return ChestEstimate(nav, steps, resting)

    def turn_back(self, yaw_error_rad: float, yaw_error_sd_rad: float) -> None:
        """Take by how much the track is turned too far, counter-clockwise, weighed against what is known of the yaw."""
        state = self.state
        known = float(state.yaw_sd_rad) ** 2
        gain = known / (known + yaw_error_sd_rad**2) if known > 0.0 else 0.0
        turn_track(-gain * yaw_error_rad, state)
        state.yaw_sd_rad = known**0.5 * (1.0 - gain) ** 0.5

    def place(self, pose: PoseEstimate, keep_biases: bool) -> None:
        """Go on from a pose that somebody knows."""
        place(pose, self.state)
        if not keep_biases:
            forget_bias(self.state)

    def _step_taken(self, stamp_ns: int) -> StepEvent:
        """Correct the attitude and the length by the step that ends at a stamp, and begin the next."""
        state = self.state
        step = self._seen(stamp_ns, bool(correct_attitude(stamp_ns, self._settings, state)))
        wanted = self._compare(step)
        if wanted:
            compensate(*self._in_world(wanted.ahead_m, wanted.left_m), wanted.share, self._settings, state)
        keep_level(self._settings, state)
        if step.uniform and step.speed_known:
            self._remember_walk()
        event = self._event(step)
        hand_on(state)
        state.since_rest += 1
        begin_step(stamp_ns, state)
        return event

    def _seen(self, stamp_ns: int, uniform: bool) -> ChestStep:
        state = self.state
        moved = state.position_m - state.step_start_m
        f = state.step_figures
        figures = (f[SUM] / f[SAMPLES], f[LARGEST], f[LEAST], f[MAGNITUDES] / f[SAMPLES])
        c, n = cos(self._step_yaw_rad), sin(self._step_yaw_rad)
        beside = c * moved[0] + n * moved[1], c * moved[1] - n * moved[0]
        known, since_rest = state.settle_ns == NO_STAMP, int(state.since_rest)
        return ChestStep(int(state.step_start_ns), stamp_ns, uniform, known, since_rest, beside, figures)

    @property
    def _step_yaw_rad(self) -> float:
        """Where the chest points in this step: the mean over two, since the trunk twists once in them."""
        both = self.state.step_yaw + self.state.yaw_before
        return atan2(both[1], both[0])

    def _in_world(self, ahead_m: float, left_m: float) -> tuple[float, float]:
        c, n = cos(self._step_yaw_rad), sin(self._step_yaw_rad)
        return c * ahead_m - n * left_m, n * ahead_m + c * left_m

    def _remember_walk(self) -> None:
        """Remember the velocity of a uniform step beside the way the chest points."""
        state = self.state
        x, y, _ = (state.position_m - state.step_start_m) / state.step_s
        c, n = cos(self._step_yaw_rad), sin(self._step_yaw_rad)
        state.walk_mps[:] = c * x + n * y, c * y - n * x
        state.even_ns, state.even_m[:] = state.last_ns, state.position_m
        state.walking = True

    def _event(self, step: ChestStep) -> StepEvent:
        """Return the step."""
        state = self.state
        state.step_number += 1
        sd_m = float(state.velocity_sd_mps * state.step_s)
        return StepEvent(
            index=int(state["step_number"]),
            start_ns=step.start_ns,
            stamp_ns=step.stamp_ns,
            position_m=state.position_m.copy(),
            displacement_m=state.position_m - state.step_start_m,
            displacement_covariance_m2=np.eye(3) * sd_m**2,
            yaw_rad=self._step_yaw_rad,
            yaw_sd_rad=float(state.yaw_sd_rad),
            position_covariance_m2=np.eye(3) * float(state.position_sd_m) ** 2,
        )

    @property
    def health(self) -> FilterHealth:
        """How far the estimate can be trusted now."""
        return judged(self.state, self._settings)

    @property
    def notices(self) -> list[Notice]:
        """What a person should know."""
        return notices(self.state)
