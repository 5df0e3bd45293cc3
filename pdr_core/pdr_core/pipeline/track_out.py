"""What is given out of a track that two navigate by turns: nothing twice, no jump, steps with the next numbers."""

from dataclasses import replace

import numpy as np

from pdr_core.conventions import GAP_NS, NO_STAMP
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.records import Floats, NavBlock, StanceBlock, StepEvent, length, part


class TrackOut:
    """Knows what was given out last."""

    def __init__(self) -> None:
        self._told_ns = NO_STAMP  # the last estimate
        self._told_m: Floats = np.zeros(3)
        self._count = 0  # steps

    def begin(self, position_m: Floats) -> None:
        """Give out what comes from a position (3,) on, and number the steps anew."""
        self._told_m, self._count = position_m, 0

    def forget_clock(self) -> None:
        """Take every stamp for new."""
        self._told_ns = NO_STAMP

    def given(self, judged: StanceBlock, nav: NavBlock, steps: list[StepEvent]) -> FootOutput:
        """Return the estimates that are new, under their samples, and the steps with the next numbers."""
        numbered = [replace(step, index=self._count + i) for i, step in enumerate(steps, 1)]
        self._count += len(steps)
        first = int(np.searchsorted(nav.stamp_ns, self._told_ns, side="right"))
        if first < length(nav):
            self._told_ns, self._told_m = int(nav.stamp_ns[-1]), nav.position_m[-1]
        return FootOutput(part(judged, first), part(nav, first), numbered)

    def going_on(self, nav: NavBlock) -> NavBlock:
        """Return the new estimates so that they begin where the foot was said to be last, and end where they do.

        The filter lost the foot in its swing, and what is reckoned between two stands is a straight and even way.
        """
        nav = part(nav, int(np.searchsorted(nav.stamp_ns, self._told_ns, side="right")))
        if self._told_ns == NO_STAMP or not length(nav):
            return nav
        start_ns = self._told_ns if nav.stamp_ns[0] - self._told_ns <= GAP_NS else nav.stamp_ns[0]
        left = (nav.stamp_ns[-1] - nav.stamp_ns) / max(nav.stamp_ns[-1] - start_ns, 1)
        return nav._replace(position_m=nav.position_m + left[:, None] * (self._told_m - nav.position_m[0]))
