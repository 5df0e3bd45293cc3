"""The memory-based graph-theoretic detector (MBGTD): what a standing foot feels does not change abruptly.

The samples of a window are the nodes of a graph whose edges are as long as the specific forces differ. It is cut in
an older and a newer part, in every way, samples in between left out; the statistic is the largest mean length of the
edges from one part to the other. Where nothing changes, no cut is long. Nikovski and Jain, Memory-based algorithms
for abrupt change detection in sensor data streams, 2007; for human motion Olivares et al., Detection of (in)activity
periods in human body motion using inertial sensors: a comparative study, Sensors 12(5), 2012.

Left open there and chosen here: the force as a vector (its magnitude does not see a turn); the mean over the edges of
a cut, since their sum grows with the rate; a window centred on the sample. The cost grows with the square of the
samples in a window.
"""

import numpy as np

from pdr_core.maths.centred_window import centred_windows
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import difference, norm, row
from pdr_core.records import Floats, ImuBlock


@compiled
def statistics(imu: ImuBlock, start: int, stop: int, half_window_ns: int) -> Floats:
    """Return the largest mean edge of a cut [m/s^2] around the samples start:stop; infinity for a lonely sample."""
    firsts, lasts = centred_windows(imu.stamp_ns, start, stop, half_window_ns)
    out = np.empty(firsts.shape[0])
    edges = np.empty(max(0, np.max(lasts - firsts)) if firsts.shape[0] else 0)
    for i in range(firsts.shape[0]):
        out[i] = longest_cut(imu.accel_mps2[firsts[i] : lasts[i]], edges)
    return out


@compiled
def longest_cut(force_mps2: Floats, edges: Floats) -> float:
    """Return the largest mean distance between the rows up to one and the rows from a later one on; `edges` is scratch.

    With the edges from all older rows to a newer one summed up as the older part grows, each cut costs one addition.
    One row has no cut: infinity.
    """
    n = force_mps2.shape[0]
    if n < 2:
        return np.inf
    edges[:n] = 0.0
    longest = 0.0
    for older in range(n - 1):
        total = 0.0
        for newer in range(n - 1, older, -1):
            edges[newer] += norm(difference(row(force_mps2, older), row(force_mps2, newer)))
            total += edges[newer]
            longest = max(longest, total / ((older + 1) * (n - newer)))
    return longest
