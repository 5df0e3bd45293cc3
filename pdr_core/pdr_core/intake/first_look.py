"""What a stream typically shows in its first second, once."""

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.records import Floats, Stamps

FIRST_LOOK_S = 1.0


class FirstLook:
    """Collects a quantity until a second has passed. A clock that jumps back later does not start it anew."""

    def __init__(self) -> None:
        self.start_ns = NO_STAMP
        self.over = False
        self._values: list[float] = []

    def typical(self, stamp_ns: Stamps, values: Floats) -> float | None:
        """Take the next values, (n,); return the median of those of the first second when it is over, else None."""
        if self.over or not len(stamp_ns):
            return None
        if self.start_ns == NO_STAMP:
            self.start_ns = int(stamp_ns[0])
        later = stamp_ns - self.start_ns >= FIRST_LOOK_S * NANOSECONDS
        self.over = bool(later.any())
        self._values.extend(values[: int(later.argmax()) if self.over else None].tolist())
        return float(np.median(self._values)) if self.over else None
