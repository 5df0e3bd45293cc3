"""The filter and dead reckoning, of which one navigates, and how the track goes over from one to the other.

The gyro goes off: the foot stood last where the filter says; the strides after it are reckoned. It comes on: the filter
levels the foot where it stands, at the pose that was reckoned for that stand. So neither way has a jump.
"""

from pdr_core.eskf import ZuptFilter
from pdr_core.gait.dead_reckoning import GaitDeadReckoning
from pdr_core.params import Params, changed
from pdr_core.pipeline.recent_track import RecentTrack
from pdr_core.pipeline.reckoned_health import reckoned_health
from pdr_core.records import FilterHealth, Floats, Handover, NavBlock, Notice, PoseEstimate, StanceBlock, StepEvent


class Navigators:
    """Begins with the filter."""

    def __init__(self, params: Params) -> None:
        self._filter = ZuptFilter(changed(params, "filter", heading_feedback=False).filter, params.place)
        self.reckoning = GaitDeadReckoning(params.dead_reckoning)
        self.track = RecentTrack()  # of the filter
        self.filtering = True

    def filtered(self, judged: StanceBlock) -> tuple[NavBlock, list[StepEvent]]:
        """Return what the filter says of samples with rates."""
        nav, steps = self._filter.run(judged)
        self.track.add(nav, judged.stance)
        return nav, steps

    def know_turn(self, share: float) -> None:
        """Take only a share of the noise of the next rates to act about the vertical, until something else is said."""
        self._filter.know_turn(share)

    def finish_filter(self) -> list[StepEvent]:
        """Return the step that ends in the stance which the samples end in, if it does."""
        return self._filter.finish()

    def leave_filter(self) -> int | None:
        """Reckon from where the foot stood last; return when that was, None: nobody knows."""
        self.filtering = False
        if not (stood := self.track.stood):
            return None
        self.reckoning.begin(Handover(*stood, self._filter.handover.biases))
        return stood[0]

    def return_to_filter(self, at_once: bool) -> None:
        """Let the filter go on where dead reckoning has the foot; `at_once`: it stands for an instant alone."""
        self._filter.reset(self.reckoning.handover, at_once)
        self.track.forget()
        self.filtering = True

    def place(self, stamp_ns: int, pose: PoseEstimate, keep_biases: bool) -> None:
        """Go on from a pose at which somebody says the foot stands, at a stamp unless a later one is known."""
        now = self.handover
        start = Handover(max(now.stamp_ns, stamp_ns), pose, now.biases if keep_biases else None)
        if self.filtering:
            self._filter.reset(start)
        self.reckoning.begin(start)
        self.track.forget()

    def take_heading(self, yaw_error_rad: float, yaw_error_sd_rad: float) -> None:
        """Take by how much the track is turned too far now, counter-clockwise, whoever navigates."""
        if self.filtering:
            self._filter.take_heading(yaw_error_rad, yaw_error_sd_rad)
            self.track.move(self._filter.handover.pose)
        else:
            self.reckoning.take_heading(yaw_error_rad, yaw_error_sd_rad)

    @property
    def handover(self) -> Handover:
        """The estimate of the one that navigates."""
        return (self._filter if self.filtering else self.reckoning).handover

    @property
    def gyro_bias_radps(self) -> Floats:
        """The gyro bias (3,) that the filter knows."""
        return self._filter.state.gyro_bias_radps.copy()

    def health(self, stamp_ns: int) -> FilterHealth:
        """Return how far the estimate can be trusted at a stamp."""
        known = self._filter.health
        return known if self.filtering else reckoned_health(known, stamp_ns, self.handover.pose)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._filter.notices + self.reckoning.notices
