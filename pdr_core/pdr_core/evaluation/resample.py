"""The estimate at the stamps of the truth, gathered piece by piece."""

import numpy as np

from pdr_core.records import Floats, Stamps


class AtStamps:
    """Positions interpolated linearly at wanted stamps; what is kept does not grow with the estimate.

    An estimate with exactly a wanted stamp gives exactly that sample, and where the pieces are cut changes nothing.
    """

    def __init__(self, wanted_ns: Stamps) -> None:
        """Raise ValueError unless the wanted stamps, (n,), ascend."""
        if np.any(np.diff(wanted_ns) < 0):
            raise ValueError("the stamps of the truth do not ascend")
        self._wanted_ns = wanted_ns
        self.position_m: Floats = np.full((len(wanted_ns), 3), np.nan)  # NaN outside `covered`
        self.covered = slice(0, 0)  # the rows that lie within the estimate
        self._stamp_ns: Stamps = np.empty(0, dtype=np.int64)  # of the last sample
        self._sample_m: Floats = np.empty((0, 3))

    def add(self, stamp_ns: Stamps, position_m: Floats) -> None:
        """Take the next piece of the estimate: stamps (n,) in ascending order and positions (n, 3) [m]."""
        if len(stamp_ns) == 0:
            return
        first = len(self._stamp_ns) == 0
        stamp_ns = np.concatenate([self._stamp_ns, stamp_ns])
        position_m = np.concatenate([self._sample_m, position_m])
        start = int(np.searchsorted(self._wanted_ns, stamp_ns[0], side="left"))
        stop = int(np.searchsorted(self._wanted_ns, stamp_ns[-1], side="right"))
        self._interpolate(slice(start, stop), stamp_ns, position_m)
        self.covered = slice(start if first else self.covered.start, stop)
        self._stamp_ns, self._sample_m = stamp_ns[-1:], position_m[-1:]

    def _interpolate(self, rows: slice, stamp_ns: Stamps, position_m: Floats) -> None:
        """Fill the rows; times are taken from the piece's start, so that whole nanoseconds stay exact."""
        wanted_ns = (self._wanted_ns[rows] - stamp_ns[0]).astype(np.float64)
        known_ns = (stamp_ns - stamp_ns[0]).astype(np.float64)
        for axis in range(3):
            self.position_m[rows, axis] = np.interp(wanted_ns, known_ns, position_m[:, axis])
