"""Gui's walks, simulated, and what each part of Gui's method makes of them (Gui section 5).

The closed rectangle is walked with the motion of section 5.1, which turns on the spot, and the campus of figure 6 with
the same steps along arcs. The sensor is that of Table 1, its gyro noise read as 0.1 deg/sqrt(s).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.bench.gui_variants import SENSOR, VARIANTS, told
from pdr_core.bench.table_1 import RATE_HZ
from pdr_core.conventions import seconds_between
from pdr_core.evaluation.metrics import ate2_m, path_length_m, percent
from pdr_core.evaluation.motion_plots import MotionTrack
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import SimulationParams
from pdr_core.pipeline import FootInertial
from pdr_core.records import Floats, ImuBlock, NavBlock, Stamps, StepEvent, joined, length, part
from pdr_core.simulation import SimulatedWalk, simulated_walk

PIECE = 1000  # samples


@dataclass(frozen=True)
class GuiWalk:
    """One of the walks."""

    name: str
    walk: str
    length_m: float


WALKS = (
    GuiWalk("rectangle 110 m", "rectangle", 110.0),
    GuiWalk("rectangle 360 m", "rectangle", 360.0),
    GuiWalk("campus 590 m", "campus", 590.0),
)


@dataclass(frozen=True)
class GuiResult:
    """One walk by one variant."""

    walk: str
    variant: str
    seed: int
    distance_m: float
    end_x_m: float  # where the walk ends, from where it began: the truth ends there too
    end_y_m: float
    ate2_m: float
    yaw_error_deg: float  # at the end
    strides_true: int
    strides: int  # turns on the spot too

    @property
    def end_error_m(self) -> float:
        """Distance of the end from the start."""
        return float(np.hypot(self.end_x_m, self.end_y_m))

    @property
    def end_error_percent(self) -> float:
        """Of the distance (Gui eq. 33)."""
        return percent(self.end_error_m, self.distance_m)


class Measured(NamedTuple):
    """The figures of a walk and what can be drawn of it."""

    result: GuiResult
    estimate: MotionTrack
    truth: MotionTrack


def simulated(walk: GuiWalk, seed: int) -> SimulatedWalk:
    """Return the samples of a walk."""
    return simulated_walk(
        SimulationParams(
            motion="gui",
            walk=walk.walk,
            walk_length_m=walk.length_m,
            sensor_model=SENSOR,
            sample_rate_hz=RATE_HZ,
            seed=seed,
        )
    )


def by_every_variant(walk: GuiWalk, seed: int) -> Iterator[Measured]:
    """Yield one walk by every variant."""
    sim = simulated(walk, seed)
    for name in VARIANTS:
        yield measured(walk, name, seed, sim)


def measured(walk: GuiWalk, name: str, seed: int, sim: SimulatedWalk) -> Measured:
    """Track a simulated walk by a variant."""
    variant = VARIANTS[name]
    params = told(variant)
    chain = FootInertial(params, variant.heading(params, sim))
    outputs = [*(chain.run(piece) for piece in pieces(sim.imu)), chain.finish()]
    nav, steps = joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps]
    truth = motion_track(
        "Truth", sim.imu.stamp_ns, sim.motion.position_m, sim.motion.quat_xyzw, sim.motion.velocity_mps
    )
    return Measured(compared(walk, name, seed, sim, nav, steps), estimated(name, nav), truth)


def pieces(imu: ImuBlock) -> Iterator[ImuBlock]:
    """Yield the samples as a recording is read: the filter makes room for all that it is given, at every answer."""
    for start in range(0, length(imu), PIECE):
        yield part(imu, start, start + PIECE)


def compared(
    walk: GuiWalk, name: str, seed: int, sim: SimulatedWalk, nav: NavBlock, steps: list[StepEvent]
) -> GuiResult:
    """Return the figures of a track."""
    true = sim.motion
    end_m = nav.position_m[-1] - nav.position_m[0]
    return GuiResult(
        walk=walk.name,
        variant=name,
        seed=seed,
        distance_m=path_length_m(true.position_m),
        end_x_m=float(end_m[0]),
        end_y_m=float(end_m[1]),
        ate2_m=ate2_m(nav.position_m, true.position_m[-length(nav) :]),
        yaw_error_deg=float(np.degrees(wrapped_rad(yaw_rad(nav.quat_xyzw[-1]) - yaw_rad(true.quat_xyzw[-1])))),
        strides_true=int(np.sum(np.diff(true.stance.astype(int)) == 1)),
        strides=len(steps),
    )


def estimated(name: str, nav: NavBlock) -> MotionTrack:
    """Return how an estimate moved."""
    velocity_mps = Rotation.from_quat(nav.quat_xyzw).apply(nav.velocity_mps)
    return motion_track(name, nav.stamp_ns, nav.position_m, nav.quat_xyzw, velocity_mps)


def motion_track(
    name: str, stamp_ns: Stamps, position_m: Floats, quat_xyzw: Floats, velocity_mps: Floats
) -> MotionTrack:
    """Return how a foot moved in the world frame: (n, 3), (n, 4), (n, 3)."""
    euler_rad = Rotation.from_quat(quat_xyzw).as_euler("ZYX")[:, ::-1]
    time_s = seconds_between(stamp_ns, int(stamp_ns[0]))
    return MotionTrack(name, time_s, position_m, np.degrees(np.unwrap(euler_rad, axis=0)), velocity_mps)
