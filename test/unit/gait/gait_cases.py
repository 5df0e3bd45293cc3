"""Simulated walks whose strides are known, and what the analysis makes of them."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import FootGait, FootInertial
from pdr_core.records import ImuBlock, Notice, length, part
from pdr_core.records_gait import Mounting, Stride
from pdr_core.simulation import SimulatedWalk, simulated_walk
from pdr_core.simulation.foot_motion import PUSH_SHARE, FootCourse
from pdr_core.simulation.walk import course


@dataclass(frozen=True)
class Analysed:
    """What came out of a walk."""

    strides: list[Stride]
    mounting: Mounting | None
    notices: list[Notice]

    def each(self, name):
        """One figure of every stride."""
        return [getattr(stride, name) for stride in self.strides]


def analysed(imu: ImuBlock, cuts=(), params: Params | None = None) -> Analysed:
    """Run chain and analysis over samples in pieces."""
    chain, gait, strides = FootInertial(params or Params()), FootGait(), []
    borders = [0, *cuts, length(imu)]
    for start, stop in pairwise(borders):
        strides += gait.run(chain.run(part(imu, start, stop)))
    strides += gait.run(chain.finish())
    return Analysed(strides + gait.finish(), gait.mounting, gait.notices)


def smooth_walk(walk: str = "straight", **more) -> tuple[SimulatedWalk, FootCourse]:
    """Return a walk of the smooth foot with its course."""
    defaults = {"walk_length_m": 30.0, "sensor_model": "ideal"}
    params = SimulationParams(motion="smooth", walk=walk, **{**defaults, **more})
    return simulated_walk(params), course(params)


def tipped_s(foot: FootCourse, swing_s: float) -> np.ndarray:
    """When the foot is tipped farthest: the toe has left the ground for a share of the swing."""
    return foot.strikes_s - (1.0 - PUSH_SHARE) * swing_s
