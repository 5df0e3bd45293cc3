"""The walks of Qiu's Tables 3, 4 and 5 and his stairs, simulated, and how a method tracks one of them.

The sensor is that of Qiu's Table 1, and every seed draws another one. The rectangle and the stairs are in a building
with iron in its floors, the track lies outdoors. The tables print distances as calculated; those of Table 3 are taken
for the true ones here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.bench.mocap_gait import tracked, verdicts
from pdr_core.bench.trial import Walk
from pdr_core.conventions import seconds_between
from pdr_core.evaluation.course_plots import CourseTrack
from pdr_core.evaluation.metrics import closure_2d_m, percent, stride_distance_m
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import Floats, ImuBlock, NavBlock, Stamps, StepEvent, joined
from pdr_core.simulation.courses import ahead
from pdr_core.simulation.foot_motion import FootCourse
from pdr_core.simulation.gait import WALK, Stride
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.qiu_courses import qiu_rectangle, stair_climb, track
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.simulation.walk import walked

RATE_HZ = 100.0
SENSOR = SENSOR_MODELS["qiu_table_1"]
INDOOR_FIELD = 0.25
LEVEL_M = 2.8  # before and after the stairs
TABLE_3 = ((57, 49.51), (60, 48.73), (59, 49.19), (56, 50.85), (55, 51.33), (59, 50.46))  # strides, walking distance
TABLE_4 = (315, 318, 321, 324, 327)  # strides of five laps: 321 +- 6
TABLE_5 = ((321,), (327, 327), (297,), (307, 306))  # strides of the laps of each subject


@dataclass(frozen=True)
class Trial:
    """One walk, and the seed of all that is drawn."""

    table: str
    name: str
    strides: list[Stride]
    seed: int
    indoors: bool

    @property
    def distance_m(self) -> float:
        """The sum of the stride lengths."""
        return sum(stride.gait.length_m for stride in self.strides)

    @property
    def turns(self) -> int:
        """How many turns by 90 degrees."""
        return round(abs(sum(stride.turn_rad for stride in self.strides)) / (0.5 * np.pi))


def trials() -> list[Trial]:
    """Return all walks, table by table."""
    indoors = [Trial("3", str(i), qiu_rectangle(*row), i, True) for i, row in enumerate(TABLE_3, 1)]
    one_subject = [Trial("4", str(i), track([count]), i, False) for i, count in enumerate(TABLE_4, 1)]
    subjects = [Trial("5", str(i), track(counts), i, False) for i, counts in enumerate(TABLE_5, 1)]
    climbs = [Trial("stairs", str(i), stair_climb(ahead(LEVEL_M, WALK)), i, True) for i in range(1, 5)]
    return [*indoors, *one_subject, *subjects, *climbs]


class Track(NamedTuple):
    """What a method makes of a walk."""

    nav: NavBlock
    steps: list[StepEvent]


Method = Callable[[ImuBlock, Params], Track]


def eskf(imu: ImuBlock, params: Params) -> Track:
    """Track a foot by the suite's own chain."""
    chain = FootInertial(params)
    outputs = [chain.run(imu), chain.finish()]
    return Track(joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps])


def by_orientation(name: str) -> Method:
    """Return the method that orients a foot as `bench.orientations` names it and takes the drift off each swing."""

    def method(imu: ImuBlock, params: Params) -> Track:
        oriented = tracked(name, verdicts(Walk(name, [imu], None), params), params)
        return Track(oriented.nav, oriented.steps)

    return method


METHODS: dict[str, Method] = {
    "ESKF": eskf,
    "EKF": by_orientation("quaternion_ekf"),
    "CF": by_orientation("complementary"),
    "GDA": by_orientation("gradient_descent"),
}


def told() -> Params:
    """Return parameters that know the ranges of the sensor and its biases, which are those of its data sheet.

    Its noise is below what the suite takes every sensor to have. Every method may use the magnetic field.
    """
    params = changed(
        Params(), "intake", gyro_range_radps=SENSOR.gyro_range_radps, accel_range_mps2=SENSOR.accel_range_mps2
    )
    params = changed(params, "attitude", use_field=True)
    return changed(
        params,
        "filter",
        initial_gyro_bias_sd_radps=SENSOR.gyro_bias_sd_radps,
        initial_accel_bias_sd_mps2=SENSOR.accel_bias_sd_mps2,
    )


@dataclass(frozen=True)
class QiuResult:
    """One walk by one method, with the truth."""

    table: str
    trial: str
    method: str
    strides_true: int
    strides: int
    distance_true_m: float
    distance_m: float  # the sum of the stride lengths
    end_error_m: float  # horizontal, of the way from start to end
    heading_deg: float  # at the end, within -180 .. 180
    heading_error_deg: float
    turns: int  # by 90 degrees
    height_true_m: float
    height_m: float

    @property
    def distance_error_percent(self) -> float:
        """Calculated minus true."""
        return percent(self.distance_m - self.distance_true_m, self.distance_true_m)

    @property
    def end_error_percent(self) -> float:
        """In percent of the distance."""
        return percent(self.end_error_m, self.distance_true_m)

    @property
    def error_per_turn_deg(self) -> float:
        """The heading error at the end, shared out to the turns; without turns it is left whole."""
        return abs(self.heading_error_deg) / max(1, self.turns)

    @property
    def height_error_percent(self) -> float:
        """Calculated minus true, of the climb."""
        return percent(self.height_m - self.height_true_m, self.height_true_m)


class Measured(NamedTuple):
    """The figures of a walk and what can be drawn of it."""

    result: QiuResult
    estimate: CourseTrack
    truth: CourseTrack
    steps: list[StepEvent]


def measured(trial: Trial, method: str = "ESKF", sensor: SensorModel = SENSOR) -> Measured:
    """Simulate a walk and track it."""
    params = SimulationParams(
        motion="smooth",
        sample_rate_hz=RATE_HZ,
        magnetometer=True,
        indoor_field=INDOOR_FIELD * trial.indoors,
        seed=trial.seed,
    )
    walk = walked(FootCourse(trial.strides), params, model=sensor)
    nav, steps = METHODS[method](walk.imu, told())
    start_ns = int(walk.imu.stamp_ns[0])
    estimate = course_track(method, nav.stamp_ns, start_ns, nav.position_m, nav.quat_xyzw)
    truth = course_track("Truth", walk.imu.stamp_ns, start_ns, walk.motion.position_m, walk.motion.quat_xyzw)
    return Measured(compared(trial, method, steps, estimate, truth), estimate, truth, steps)


def course_track(name: str, stamp_ns: Stamps, start_ns: int, position_m: Floats, quat_xyzw: Floats) -> CourseTrack:
    """Return where a foot went and how it turned."""
    yaw_rad = np.unwrap(Rotation.from_quat(quat_xyzw).as_euler("ZYX")[:, 0])
    return CourseTrack(name, seconds_between(stamp_ns, start_ns), position_m - position_m[0], np.degrees(yaw_rad))


def compared(trial: Trial, method: str, steps: list[StepEvent], estimate: CourseTrack, truth: CourseTrack) -> QiuResult:
    """Return the figures of a track."""
    end_m, true_end_m = estimate.position_m[-1], truth.position_m[-1]
    return QiuResult(
        table=trial.table,
        trial=trial.name,
        method=method,
        strides_true=len(trial.strides),
        strides=len(steps),
        distance_true_m=trial.distance_m,
        distance_m=stride_distance_m(steps),
        end_error_m=closure_2d_m(true_end_m, end_m),
        heading_deg=wrapped_deg(estimate.heading_deg[-1]),
        heading_error_deg=wrapped_deg(estimate.heading_deg[-1] - truth.heading_deg[-1]),
        turns=trial.turns,
        height_true_m=float(true_end_m[2]),
        height_m=float(end_m[2]),
    )


def wrapped_deg(angle_deg: float) -> float:
    """Return the same angle within -180 .. 180."""
    return float((angle_deg + 180.0) % 360.0 - 180.0)
