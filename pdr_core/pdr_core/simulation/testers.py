"""The four persons of Zhou's Table 4, and how their strides vary.

Statures and heading deviations are those of the table. A stride takes 1.2 s, of which the foot is still for 0.3 (Table
8): the usual walk at 0.81 of its speed. What people are not told of, and where it comes from:

    how the foot's direction varies   Table 4's range, read as four standard deviations
    how speed varies                  stride times vary by 2 %: 1.3 % (Hausdorff 1999, young adults) to 4 % (Hausdorff
                                      1995, nine minutes); length and frequency share a change of speed, each its root
    for how long it keeps a change    long-range correlations (Hausdorff 1995); here a first-order process
    where a foot comes down           `simulation.placement_sd_m`
    running                           Zhou's figure 12 shows another deviation than figure 8, without a number
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from pdr_core.records import Floats
from pdr_core.records_gait import Behaviour
from pdr_core.simulation.foot_motion import stands
from pdr_core.simulation.gait import STATURE_M, Stride

PACE, POINTING, PLACEMENT = 11, 12, 10  # these streams of a seed
RUNNING_SHARE = 0.5  # of the deviation in walking
KEPT = 0.97  # of a change of speed from stride to stride: half of it is gone after 23
ZHOU_PACE = 0.81


class Tester(NamedTuple):
    """A person."""

    stature_m: float
    deviation_rad: float  # walking direction less heading of the foot (Zhou eq. 16), counter-clockwise
    deviation_sd_rad: float = 0.0
    pace: float = 1.0
    pace_sd: float = 0.0
    placed: bool = False  # the foot comes down beside where it should

    def deviations_rad(self, strides: Sequence[Stride], seed: int) -> Floats:
        """Return the deviation of the foot where it stands before the first stride and after each, (strides + 1,)."""
        noise = np.random.default_rng([seed, POINTING]).standard_normal(len(strides) + 1)
        return self.usual_deviations_rad(strides) + self.deviation_sd_rad * noise

    def usual_deviations_rad(self, strides: Sequence[Stride]) -> Floats:
        """Return the same without its scatter."""
        running = np.array([False, *(s.gait.behaviour is Behaviour.RUNNING for s in strides)])
        return np.where(running, RUNNING_SHARE, 1.0) * self.deviation_rad

    def varied(self, strides: Sequence[Stride], seed: int) -> list[Stride]:
        """Return the strides at a speed that varies: who walks faster is farther after as many of them."""
        if not self.pace_sd:
            return list(strides)
        rng, change, row = np.random.default_rng([seed, PACE]), 0.0, []
        change = rng.standard_normal()
        for stride in strides:
            row.append(replace(stride, gait=stride.gait.paced(float(np.exp(self.pace_sd * change)))))
            change = KEPT * change + float(np.sqrt(1.0 - KEPT**2)) * rng.standard_normal()
        return row


def zhous(stature_m: float, deviation_deg: float, least_deg: float, most_deg: float) -> Tester:
    """Return a tester of Table 4."""
    sd_rad = float(np.radians(most_deg - least_deg)) / 4.0
    return Tester(stature_m, float(np.radians(deviation_deg)), sd_rad, ZHOU_PACE, 0.04, placed=True)


TESTERS = {
    "none": Tester(STATURE_M, 0.0),
    "a": zhous(1.75, 29.2, 27.5, 30.3),
    "b": zhous(1.80, 5.8, 5.1, 7.1),
    "c": zhous(1.58, 15.6, 15.2, 17.7),
    "d": zhous(1.60, 8.7, 7.3, 9.5),
}


def footprints(strides: Sequence[Stride], tester: Tester, placement_sd_m: float, seed: int) -> Floats:
    """Return where a tester's foot stands, (strides + 1, 4) x, y, z and yaw; the way begins at the origin along x."""
    places = stands(strides)
    places[:, 3] -= tester.deviations_rad(strides, seed)
    if tester.placed:
        spread = np.random.default_rng([seed, PLACEMENT]).standard_normal((len(places), 2))
        spread[[0, -1]] = 0.0
        places[:, :2] += placement_sd_m * spread
    return places
