"""The filter stage: samples with verdicts in, estimates and steps out."""

import numpy as np

from pdr_core.eskf import health
from pdr_core.eskf.navigate import navigate
from pdr_core.eskf.settings import settings
from pdr_core.eskf.state import FilterState, fresh_state
from pdr_core.eskf.step_events import step_taken
from pdr_core.params import FilterParams, PlaceParams
from pdr_core.records import NavBlock, Notice, StanceBlock, StepEvent, length


class ZuptFilter:
    """A 15-state error-state Kalman filter with zero-velocity updates (Gui section 4.2, Zhou section 2.1)."""

    def __init__(self, params: FilterParams, place: PlaceParams) -> None:
        self._settings = settings(params, place)
        self.state: FilterState = fresh_state()

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
        return self._step_taken() if self.state.ends.stamp_ns[1] >= 0 else []

    def _step_taken(self) -> list[StepEvent]:
        step = step_taken(self.state.ends)
        return [step] if step else []

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return health.notices(self.state)

    def reset(self) -> None:
        """Forget everything."""
        self.state = fresh_state()


def empty_nav(count: int) -> NavBlock:
    """Return room for `count` estimates."""
    return NavBlock(
        np.empty(count, np.int64),
        np.empty((count, 3)),
        np.empty((count, 4)),
        np.empty((count, 3)),
        np.empty((count, 3)),
        np.empty((count, 6, 6)),
        np.empty((count, 3, 3)),
    )
