"""The filter stage: samples with verdicts in, estimates and steps out."""

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.eskf import health
from pdr_core.eskf.configure import settings
from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, POSITION
from pdr_core.eskf.navigate import navigate
from pdr_core.eskf.output import empty_nav
from pdr_core.eskf.state import FilterState, fresh_state
from pdr_core.eskf.step_events import step_taken
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import FilterParams, PlaceParams
from pdr_core.records import FilterHealth, NavBlock, Notice, PoseEstimate, StanceBlock, StepEvent, length


class ZuptFilter:
    """A 15-state error-state Kalman filter with zero-velocity updates (Gui section 4.2, Zhou section 2.1)."""

    def __init__(self, params: FilterParams, place: PlaceParams) -> None:
        self._settings = settings(params, place)
        self._usual_sd = self._settings.initial_sd
        self._resets = 0
        self.state: FilterState = fresh_state()
        self.state.P[:] = np.diag(self._usual_sd**2)

    def run(self, block: StanceBlock) -> tuple[NavBlock, list[StepEvent]]:
        """Return an estimate for every sample, and the steps that are certain with them."""
        nav, steps, done = empty_nav(length(block)), [], 0
        while done < length(block):
            done, stance_is_over = navigate(block, done, self._settings, self.state, nav)
            if stance_is_over:
                steps += self._step_taken()
        return nav, steps

    def finish(self) -> list[StepEvent]:
        """Return the step that ends in the stance which the recording ends in, if it does."""
        return self._step_taken() if self.state.end_ns[1] != NO_STAMP else []

    def _step_taken(self) -> list[StepEvent]:
        step = step_taken(self.state, self._settings.step_min_m, self._settings.step_turn_min_rad)
        return [step] if step else []

    @property
    def health(self) -> FilterHealth:
        """How far the filter can be trusted now."""
        return health.judged(self.state, self._resets)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return health.notices(self.state)

    def reset(self, pose: PoseEstimate, keep_biases: bool) -> None:
        """Start anew at a pose: the foot is levelled there by the next samples, so it should stand still."""
        before, self._resets = self.state, self._resets + 1
        yaw = yaw_rad(before.quat_xyzw) if pose.quat_xyzw is None else yaw_rad(pose.quat_xyzw)
        sd = self._usual_sd.copy()
        sd[POSITION : POSITION + 3] = np.sqrt(np.diag(pose.covariance)[:3])
        sd[ATTITUDE + 2] = np.sqrt(pose.covariance[5, 5])
        self.state = fresh_state()
        self.state.position_m[:] = pose.position_m
        if keep_biases:
            sd[ACCEL_BIAS:] = np.sqrt(np.diag(before.P)[ACCEL_BIAS:])
            self.state.accel_bias_mps2[:] = before.accel_bias_mps2
            self.state.gyro_bias_radps[:] = before.gyro_bias_radps
        self.state.P[:] = np.diag(sd**2)
        self._settings = self._settings._replace(initial_yaw_rad=yaw, initial_sd=sd)
