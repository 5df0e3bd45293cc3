"""The filter stage: samples with verdicts in, estimates and steps out."""

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.eskf import health
from pdr_core.eskf.answers import NOTHING_DUE_NS, Answers
from pdr_core.eskf.configure import settings
from pdr_core.eskf.eleven_states import estimated, turn_back
from pdr_core.eskf.handover import handed_over, initial_deviations
from pdr_core.eskf.navigate import navigate
from pdr_core.eskf.output import empty_nav
from pdr_core.eskf.state import FilterState, fresh_state
from pdr_core.eskf.step_events import step_taken
from pdr_core.eskf.updates import correct_heading, correct_position
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import FilterParams, PlaceParams
from pdr_core.records import (
    FilterHealth,
    Handover,
    HeadingObservation,
    HeadingSource,
    NavBlock,
    Notice,
    StanceBlock,
    StepEvent,
    joined,
    length,
    part,
)


class ZuptFilter:
    """A 15-state error-state Kalman filter with zero-velocity updates (Gui section 4.2, Zhou section 2.1)."""

    def __init__(self, params: FilterParams, place: PlaceParams) -> None:
        self._settings = self._usual = settings(params, place)
        self.asks = params.heading_feedback
        self._answer_due_ns = nanoseconds(params.heading_due_s)
        self._answers = Answers()
        self._held: StanceBlock | None = None  # samples behind one that waits for an answer
        self.handovers: list[Handover] = []  # one for each step that `run` or `finish` returned last
        self._resets = 0
        self.state: FilterState = fresh_state()
        self.state.P[:] = np.diag(self._usual.initial_sd**2)

    def run(self, block: StanceBlock) -> tuple[NavBlock, list[StepEvent]]:
        """Return an estimate of each sample up to one that must wait for an answer, and the steps certain with them."""
        block, self._held, self.handovers = joined([self._held, block]) if self._held else block, None, []
        nav, steps, done = empty_nav(length(block)), [], 0
        while done < length(block):
            done, stance_is_over = navigate(block, done, self._stop_ns, self._settings, self.state, nav)
            if stance_is_over:
                steps += self._step_taken(int(block.imu.stamp_ns[done]))
            elif done < length(block) and not self._answered(int(block.imu.stamp_ns[done])):
                self._held = part(block, done)
                return joined([part(nav, 0, done)]), steps  # a copy: without the room for what waits
        return nav, steps

    def know_turn(self, share: float) -> None:
        """Take only a share of the noise of the next rates to act about the vertical, until something else is said."""
        self._settings = self._settings._replace(process=self._settings.process._replace(share_about_up=share))

    def finish(self) -> list[StepEvent]:
        """Return the step that ends in the stance which the recording ends in, if it does."""
        self.handovers = []
        return self._step_taken(int(self.state.last_ns)) if self.state.end_ns[1] != NO_STAMP else []

    def answer(self, observation: HeadingObservation) -> None:
        """Take the answer to a step; `resume` goes on with what waited for it."""
        self._answers.take(observation)

    def take_heading(self, yaw_error_rad: float, yaw_error_sd_rad: float) -> None:
        """Take by how much the track is turned too far now, counter-clockwise, as somebody knows who was not asked."""
        correct_heading(yaw_error_rad, yaw_error_sd_rad, self.state)

    def give_up_answers(self) -> None:
        """Take the answers for which samples wait as empty."""
        if self._held:
            self._answers.give_up(int(self._held.imu.stamp_ns[0]))

    def resume(self) -> tuple[NavBlock, list[StepEvent]]:
        """Go on with the samples that waited; return what `run` does."""
        held, self._held = self._held, None
        self.handovers = []
        return self.run(held) if held else (empty_nav(0), [])

    @property
    def waits(self) -> bool:
        """Samples wait for an answer."""
        return self._held is not None

    @property
    def _stop_ns(self) -> int:
        return self._answers.next_ns if self.asks else NOTHING_DUE_NS

    def _answered(self, stamp_ns: int) -> bool:
        """Apply the answers that are due; return False where one is missing."""
        if self._answers.missing(stamp_ns):
            return False
        for answer in self._answers.applying(stamp_ns):
            if answer.source is not HeadingSource.NONE:
                self._turn_back(answer.yaw_error_rad, answer.yaw_error_sd_rad)
            if answer.position:
                correct_position(answer.position.error_m, answer.position.covariance_m2, self.state)
        return True

    def _turn_back(self, yaw_error_rad: float, sd_rad: float) -> None:
        if self._settings.heading_states:
            correct_heading(yaw_error_rad, sd_rad, self.state)
        else:
            turn_back(yaw_error_rad, self.state)

    def _step_taken(self, known_ns: int) -> list[StepEvent]:
        due_ns = known_ns + self._answer_due_ns if self.asks else NO_STAMP
        step = step_taken(self.state, self._settings, due_ns)
        if step is None:
            return []
        if self.asks:
            self._answers.ask(step)
        self.handovers.append(self.handover)
        return [step]

    @property
    def health(self) -> FilterHealth:
        """How far the filter can be trusted now."""
        return health.judged(self.state, self._resets)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return health.notices(self.state) + self._answers.notices

    @property
    def handover(self) -> Handover:
        """The estimate, for another estimator that goes on from it."""
        return handed_over(self.state)

    def reset(self, start: Handover, at_once: bool = False) -> None:
        """Start anew where another estimator ended: the foot is levelled there, so it should stand still.

        `at_once`: by the first sample alone, for a foot that stands for an instant.

        A pose without a quaternion keeps the yaw; biases of None are those that any sensor may bring. With the biases
        goes the gravity that the filter knows: a foot in the middle of a walk does not rest as well as at its start.
        """
        quat_xyzw = self.state.quat_xyzw if start.pose.quat_xyzw is None else start.pose.quat_xyzw
        sd = estimated(initial_deviations(start, self._usual.initial_sd), self._usual.heading_states)
        self._settings = self._usual._replace(initial_yaw_rad=yaw_rad(quat_xyzw), compass_start=False, initial_sd=sd)
        if at_once:
            self._settings = self._settings._replace(alignment_ns=0)
        if start.biases and self.state.gravity_mps2 > 0.0:
            known = float(self.state.gravity_mps2)
            self._settings = self._settings._replace(gravity_mps2=known, gravity_from_rest=False)
        self._answers, self._held, self._resets = Answers(), None, self._resets + 1
        self.state = fresh_state()
        self.state.position_m[:] = start.pose.position_m
        self.state.P[:] = np.diag(sd**2)
        if start.biases:
            self.state.accel_bias_mps2[:] = start.biases.accel_mps2
            self.state.gyro_bias_radps[:] = start.biases.gyro_radps
