"""A thinned copy of a run for the pictures, of bounded memory however long the walk."""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.conventions import seconds_between
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.records import Flags, Floats, NavBlock, Stamps, StanceBlock, joined


class TracePoints(NamedTuple):
    """n samples that were kept."""

    time_s: Floats  # (n,) since the first sample
    position_m: Floats  # (n, 3)
    velocity_mps: Floats  # (n, 3) in the world frame
    horizontal_covariance_m2: Floats  # (n, 2, 2)
    height_sd_m: Floats  # (n,)
    yaw_rad: Floats  # (n,)
    stance: Flags  # (n,)
    statistic: Floats  # (n,)
    threshold: Floats  # (n,)

    @property
    def horizontal_sd_m(self) -> Floats:
        """Standard deviation, (n,), along the larger axis of the horizontal covariance."""
        xx, yy = self.horizontal_covariance_m2[:, 0, 0], self.horizontal_covariance_m2[:, 1, 1]
        xy = self.horizontal_covariance_m2[:, 0, 1]
        return np.sqrt(0.5 * (xx + yy) + np.hypot(0.5 * (xx - yy), xy))


class Trace:
    """Keeps every k-th sample, k doubling whenever `limit` is passed, and every edge of the stance."""

    def __init__(self, limit: int = 20_000) -> None:
        self._limit = limit
        self._every = 1
        self._seen = 0
        self._rows = 0
        self._kept = [_nothing()]
        self._start_ns: int | None = None
        self._standing = False
        self._last_s = 0.0
        self._on_s: list[float] = []
        self._off_s: list[float] = []

    def add(self, judged: StanceBlock, nav: NavBlock) -> None:
        """Take the next samples; both blocks have the same stamps."""
        if len(nav.stamp_ns) == 0:
            return
        if self._start_ns is None:
            self._start_ns = int(nav.stamp_ns[0])
        self._note_edges(judged.stance, self.seconds(nav.stamp_ns))
        first = -self._seen % self._every
        self._seen += len(nav.stamp_ns)
        self._kept.append(self._points(judged, nav, slice(first, None, self._every)))
        self._rows += len(self._kept[-1].time_s)
        while self._rows > self._limit:
            self._thin()

    @property
    def points(self) -> TracePoints:
        """The samples that were kept."""
        return joined(self._kept)

    @property
    def stance_intervals_s(self) -> list[tuple[float, float]]:
        """Every stance from its first sample to the first sample after it; the last may end with the trace."""
        return list(zip(self._on_s, [*self._off_s, self._last_s], strict=False))

    def seconds(self, stamp_ns: Stamps) -> Floats:
        """Return stamps [ns], (n,), as seconds since the first sample."""
        return seconds_between(stamp_ns, self._start_ns or 0)

    def _thin(self) -> None:
        """Drop every second sample."""
        self._kept = [TracePoints._make(column[::2] for column in self.points)]
        self._rows = len(self._kept[0].time_s)
        self._every *= 2

    def _note_edges(self, stance: Flags, time_s: Floats) -> None:
        edge = np.diff(np.concatenate([[self._standing], stance]).astype(np.int8))
        self._on_s += time_s[edge == 1].tolist()
        self._off_s += time_s[edge == -1].tolist()
        self._standing, self._last_s = bool(stance[-1]), float(time_s[-1])

    def _points(self, judged: StanceBlock, nav: NavBlock, rows: slice) -> TracePoints:
        covariance_m2 = nav.pose_covariance[rows]
        return TracePoints(
            time_s=self.seconds(nav.stamp_ns[rows]),
            position_m=nav.position_m[rows].copy(),
            velocity_mps=Rotation.from_quat(nav.quat_xyzw[rows]).apply(nav.velocity_mps[rows]),
            horizontal_covariance_m2=covariance_m2[:, :2, :2].copy(),
            height_sd_m=np.sqrt(covariance_m2[:, 2, 2]),
            yaw_rad=np.array([yaw_rad(quat) for quat in nav.quat_xyzw[rows]]),
            stance=judged.stance[rows].copy(),
            statistic=judged.statistic[rows].copy(),
            threshold=judged.threshold[rows].copy(),
        )


def _nothing() -> TracePoints:
    none, rows = np.empty(0), np.empty((0, 3))
    return TracePoints(none, rows, rows, np.empty((0, 2, 2)), none, none, np.empty(0, dtype=np.bool_), none, none)
