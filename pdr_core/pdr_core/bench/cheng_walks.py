"""Cheng's walks, simulated: rectangles with a stop at every corner, by the methods of Table 2 (paper 003)."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.bench.gui_walks import estimated, motion_track
from pdr_core.conventions import seconds_between
from pdr_core.evaluation.metrics import percent
from pdr_core.evaluation.motion_plots import MotionTrack
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import ChestCard
from pdr_core.records import Floats, NavBlock, joined, length
from pdr_core.simulation import SimulatedWalk, simulated_walk
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.simulation.walk import course

SENSOR, RATE_HZ = "icm_20602", 100.0
CASES_M = (32.0, 44.0, 46.0, 48.0, 45.0)  # Table 2
PAPER_M = {  # Table 2: the end errors of each case
    "PIWSLCS": (2.48, 4.95, 3.94, 4.08, 6.55),
    "TCFWSLC": (1.86, 5.72, 3.75, 3.61, 3.98),
    "ICFWSLC": (1.07, 2.01, 2.08, 1.29, 2.05),
}
SOLVED = {"step_direction": "solved"}  # eq. 13 is of lengths
METHODS: Mapping[str, Mapping[str, Any]] = {
    "PIWSLCS": {"method": "inertial", **SOLVED},
    "TCFWSLC": {"method": "traditional", **SOLVED},
    "ICFWSLC": {"method": "improved", **SOLVED},
    "ICFWSLC, ahead": {},  # the default: and nobody walks sideways
}
TABLE_2 = tuple(PAPER_M)
WALKING_MPS = 0.5
REST_ROWS = 400  # the samples of the rest at the start


@dataclass(frozen=True)
class ChengResult:
    """One walk by one method."""

    case: int  # 1 to 5; 0: another walk
    method: str
    seed: int
    distance_m: float
    end_error_m: float  # eq. 23
    footfall_error_m: float  # eq. 24
    tilt_error_deg: float  # of one level axis while walking, root mean square
    steps: int

    @property
    def end_error_percent(self) -> float:
        """Of the distance."""
        return percent(self.end_error_m, self.distance_m)


class Walked(NamedTuple):
    """The figures of a walk and what can be drawn of it."""

    result: ChengResult
    estimate: MotionTrack
    truth: MotionTrack
    falls_s: Floats  # (n,) when feet came down
    fall_errors_m: Floats  # (n,) and how far off the estimate was


class ChengWalk(NamedTuple):
    """A simulated walk, and when feet came down."""

    case: int
    seed: int
    distance_m: float
    sim: SimulatedWalk
    falls_s: Floats


def walk(case: int, seed: int, length_m: float | None = None, name: str = "rectangle") -> ChengWalk:
    """Return one of the five cases, or another walk."""
    distance_m = CASES_M[case - 1] if length_m is None else length_m
    params = SimulationParams(
        motion="chest",
        walk=name,
        walk_length_m=distance_m,
        sensor_model=SENSOR,
        sample_rate_hz=RATE_HZ,
        seed=seed,
    )
    return ChengWalk(case, seed, distance_m, simulated_walk(params), course(params).strikes_s)


def by_every_method(one: ChengWalk) -> Iterator[Walked]:
    """Yield one walk by every method."""
    for name, chest in METHODS.items():
        yield walked(one, name, changed(Params(), "chest", **chest))


def walked(one: ChengWalk, name: str, params: Params) -> Walked:
    """Track a simulated walk."""
    card = ChestCard(params)
    outputs = [card.run(one.sim.imu), card.finish()]
    nav, steps = joined([o.nav for o in outputs]), sum(len(o.steps) for o in outputs)
    true = one.sim.motion
    rows = np.minimum(np.searchsorted(seconds(nav), one.falls_s), length(nav) - 1)
    errors_m = np.linalg.norm((nav.position_m - true.position_m[: length(nav)])[:, :2], axis=1)
    result = ChengResult(
        case=one.case,
        method=name,
        seed=one.seed,
        distance_m=one.distance_m,
        end_error_m=float(errors_m[-1]),
        footfall_error_m=float(np.sqrt(np.mean(errors_m[rows] ** 2))),
        tilt_error_deg=tilt_error_deg(one, nav),
        steps=steps,
    )
    truth = motion_track("Truth", one.sim.imu.stamp_ns, true.position_m, true.quat_xyzw, true.velocity_mps)
    return Walked(result, estimated(name, nav), truth, one.falls_s, errors_m[rows])


def seconds(nav: NavBlock) -> Floats:
    """Return the times of estimates since the start of a simulated walk, (n,) [s]."""
    return seconds_between(nav.stamp_ns, 0)


def tilt_error_deg(one: ChengWalk, nav: NavBlock) -> float:
    """Return the tilt error of one level axis while the person walks, root mean square.

    Without the tilt that the accelerometer's bias looks like: levelling takes it for true, and then what is measured at
    rest points up, so it costs nothing.
    """
    rows = length(nav)
    true = Rotation.from_quat(one.sim.motion.quat_xyzw[:rows]) * taken_for_tilt(one)
    error = (Rotation.from_quat(nav.quat_xyzw) * true.inv()).as_rotvec()[:, :2]
    walking = np.linalg.norm(one.sim.motion.velocity_mps[:rows, :2], axis=1) > WALKING_MPS
    return float(np.degrees(np.sqrt(np.mean(error[walking] ** 2))))


def taken_for_tilt(one: ChengWalk) -> Rotation:
    """Return the rotation in the chest's axes that the bias of the accelerometer looks like."""
    rest = Rotation.from_quat(one.sim.motion.quat_xyzw[:REST_ROWS]).inv()
    force = rest.apply([0.0, 0.0, 9.81]).mean(axis=0)
    shown = force + SENSOR_MODELS[SENSOR].biases(one.seed)[1]
    axis = np.cross(shown, force) / (np.linalg.norm(shown) * np.linalg.norm(force))
    return Rotation.from_rotvec(axis)
