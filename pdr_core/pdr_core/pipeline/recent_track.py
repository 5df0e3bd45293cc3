"""The filter's estimates of the last seconds: where the foot stood, and how it pointed."""

import numpy as np

from pdr_core.conventions import nanoseconds
from pdr_core.eskf.output import empty_nav
from pdr_core.maths.quaternion import from_euler, matrix, multiply, yaw_rad
from pdr_core.pipeline.gait_watch import SeenStride
from pdr_core.records import Flags, NavBlock, PoseEstimate, joined, length, part
from pdr_core.records_gait import Angle

KEPT_NS = nanoseconds(6.0)  # a stride, the stand before it, and the time until both are known


class RecentTrack:
    """Remembers estimates, with the verdicts on them."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Remember nothing: another clock, or another start."""
        self._nav: NavBlock = empty_nav(0)
        self._stance: Flags = np.zeros(0, np.bool_)

    def add(self, nav: NavBlock, stance: Flags) -> None:
        """Take the next estimates."""
        self._nav, self._stance = joined([self._nav, nav]), np.concatenate([self._stance, stance])
        if length(self._nav):
            first = int(np.searchsorted(self._nav.stamp_ns, self._nav.stamp_ns[-1] - KEPT_NS))
            self._nav, self._stance = part(self._nav, first), self._stance[first:]

    def at(self, stamp_ns: int) -> PoseEstimate | None:
        """Return the pose at a stamp; None: it is not remembered."""
        i = int(np.searchsorted(self._nav.stamp_ns, stamp_ns))
        return self._pose(i) if i < length(self._nav) and stamp_ns >= self._nav.stamp_ns[0] else None

    def ends(self, stride: SeenStride) -> tuple[PoseEstimate, PoseEstimate] | None:
        """Return the poses where the foot stood before and after a stride; None: the filter has not seen both."""
        if stride.before is None or stride.stand is None:
            return None
        before, after = self.at(stride.before.stamp_ns), self.at(stride.stand.stamp_ns)
        return (before, after) if before and after else None

    def move(self, now: PoseEstimate) -> None:
        """Lay what is remembered so that its newest estimate is where the filter, corrected, has the foot now."""
        if not length(self._nav):
            return
        nav, turn = self._nav, from_euler(0.0, 0.0, yaw_of(now).rad - yaw_of(self._pose(-1)).rad)
        quat_xyzw = np.array([multiply(turn, quat) for quat in nav.quat_xyzw])
        position_m = now.position_m + (nav.position_m - nav.position_m[-1]) @ matrix(turn).T
        self._nav = nav._replace(position_m=position_m, quat_xyzw=quat_xyzw)

    @property
    def stood(self) -> tuple[int, PoseEstimate] | None:
        """When and where the foot stood last, or was last, if it is not known to have stood; None: nothing is known."""
        if not length(self._nav):
            return None
        i = int(np.flatnonzero(self._stance)[-1]) if self._stance.any() else length(self._nav) - 1
        return int(self._nav.stamp_ns[i]), self._pose(i)

    def _pose(self, i: int) -> PoseEstimate:
        nav = self._nav
        return PoseEstimate(nav.position_m[i].copy(), nav.quat_xyzw[i].copy(), nav.pose_covariance[i].copy())


def yaw_of(pose: PoseEstimate) -> Angle:
    """Return the yaw of a pose that has an attitude."""
    assert pose.quat_xyzw is not None
    return Angle(float(yaw_rad(pose.quat_xyzw)), float(np.sqrt(pose.covariance[5, 5])))
