"""Zhou's octagon, simulated: two laps by one tester, as samples of a sensor at any of the paper's rates (section 5).

The sensor samples at 600 Hz, of which each rate of the paper is a whole part; a lower rate is filtered as a sensor does
it (`maths/thinning.py`). Its magnetometer measures at 100 Hz, the most that an AK8963 can. The field is the Earth's.
"""

from dataclasses import dataclass

import numpy as np

from pdr_core.maths.quaternion import yaw_rad
from pdr_core.maths.thinning import thinned
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.records import Floats, ImuBlock, Stamps, length, part
from pdr_core.simulation import SimulatedWalk, simulated_walk
from pdr_core.simulation.foot_motion import REST_S
from pdr_core.simulation.gait import Stride
from pdr_core.simulation.testers import TESTERS
from pdr_core.simulation.walk import personal_strides
from pdr_core.simulation.zhou_courses import LAP_M, corners

FULL_HZ = 600
WALKS = {"walking": "octagon", "running": "octagon_run"}
RATES_HZ = (200, 100, 75, 50, 20)
MAGNETOMETER_HZ = 100.0


@dataclass(frozen=True)
class Trial:
    """One tester who walks or runs."""

    gait: str  # walking or running
    tester: str
    seed: int

    @property
    def simulation(self) -> SimulationParams:
        """The parameters of two laps."""
        return SimulationParams(
            motion="smooth",
            walk=WALKS[self.gait],
            walk_length_m=2.0 * LAP_M,
            tester=self.tester,
            sample_rate_hz=float(FULL_HZ),
            magnetometer=True,
            magnetometer_rate_hz=MAGNETOMETER_HZ,
            seed=self.seed,
        )


@dataclass(frozen=True)
class Octagon:
    """Two laps and what is true of them. Stands are those before the first stride and after each."""

    trial: Trial
    walk: SimulatedWalk
    stand_ns: Stamps  # (strides + 1,)
    stand_m: Floats  # (strides + 1, 2)
    stand_yaw_rad: Floats  # (strides + 1,) of the foot
    half: int  # the stand between the laps
    corners: list[int]  # stands of the second lap in a corner

    @property
    def deviation_rad(self) -> float:
        """The heading deviation of the tester in this gait, without its scatter."""
        strides = personal_strides(self.trial.simulation)
        return float(TESTERS[self.trial.tester].usual_deviations_rad(strides)[-1])

    def lap(self, number: int, rate_hz: int) -> ImuBlock:
        """Return the samples of the first lap, 1, with the rest before it, or of the second, 2."""
        keep_every = FULL_HZ // rate_hz
        imu, split_ns = self.walk.imu, self.stand_ns[self.half]
        split = int(np.searchsorted(imu.stamp_ns, split_ns)) // FULL_HZ * FULL_HZ  # a sample of every rate
        first, last = (0, split) if number == 1 else (split, length(imu))
        return thinned(imu, first, last, keep_every)


def octagon(trial: Trial) -> Octagon:
    """Walk two laps."""
    walk, strides = simulated_walk(trial.simulation), personal_strides(trial.simulation)
    rows = np.round(stands_s(strides) * FULL_HZ).astype(np.int64)
    half, motion = len(strides) // 2, walk.motion
    return Octagon(
        trial,
        walk,
        walk.imu.stamp_ns[rows],
        motion.position_m[rows, :2],
        np.array([yaw_rad(quat_xyzw) for quat_xyzw in motion.quat_xyzw[rows]]),
        half,
        [i for i in corners(strides) if i > half],
    )


def stands_s(strides: list[Stride]) -> Floats:
    """Return when the foot is flat before the first stride and after each, (strides + 1,)."""
    before_s = REST_S + np.cumsum([0.0, *(stride.duration_s for stride in strides[:-1])])
    flat_s = [s.gait.duration_s - 0.5 * s.gait.flat_s for s in strides]
    return np.append(0.5 * REST_S, before_s + flat_s)


def told() -> Params:
    """Return the parameters of all schemes: the field tells the yaw at the start, the place how large gravity is."""
    return changed(Params(), "filter", initial_yaw_source="magnetometer", gravity_source="place")


def pieces(imu: ImuBlock, piece_s: float, rate_hz: float) -> list[ImuBlock]:
    """Return samples in pieces of so long."""
    size = max(1, round(piece_s * rate_hz))
    return [part(imu, start, start + size) for start in range(0, length(imu), size)]
