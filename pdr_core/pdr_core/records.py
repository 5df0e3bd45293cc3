"""What travels between the stages. Everything is SI and says its unit; nothing here computes.

A block is a run of consecutive samples, column by column; one live sample is a block of length one. So every stage
has one method, `run(block)`, live and offline.
"""

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import NO_STAMP

Floats = NDArray[np.float64]
Stamps = NDArray[np.int64]
Flags = NDArray[np.bool_]
Block = TypeVar("Block", bound=tuple)


class ImuBlock(NamedTuple):
    """n samples of one inertial (and magnetic) sensor. A standard deviation of -1 says: this was not measured."""

    stamp_ns: Stamps  # (n,)
    gyro_radps: Floats  # (n, 3) angular rate
    accel_mps2: Floats  # (n, 3) specific force, +g upwards at rest
    gyro_sd_radps: Floats  # (n,) noise of one sample; 0 = unknown
    accel_sd_mps2: Floats  # (n,)
    field_tesla: Floats  # (n, 3) magnetic field
    field_sd_tesla: Floats  # (n,)


def inertial_block(
    stamp_ns: Stamps, gyro_radps: Floats, accel_mps2: Floats, gyro_sd_radps: Floats, accel_sd_mps2: Floats
) -> ImuBlock:
    """Return n samples of a sensor without a magnetometer."""
    n = len(stamp_ns)
    return ImuBlock(stamp_ns, gyro_radps, accel_mps2, gyro_sd_radps, accel_sd_mps2, np.zeros((n, 3)), np.full(n, -1.0))


NO_SAMPLES = inertial_block(np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), np.zeros(0))


class StanceBlock(NamedTuple):
    """n samples and the verdict on each. A rest that has just ended brings its mean rate; a deviation of 0: none."""

    imu: ImuBlock
    stance: Flags  # (n,)
    statistic: Floats  # (n,) of the detector
    threshold: Floats  # (n,) stance needs statistic <= threshold
    zero_velocity_sd_mps: Floats  # (n,) how still a standing foot is; 0: the detector does not say
    rest_rate_radps: Floats  # (n, 3)
    rest_sd_radps: Floats  # (n,)


NO_NUMBERS = np.zeros(0)
NO_VERDICTS = StanceBlock(
    NO_SAMPLES, np.zeros(0, np.bool_), NO_NUMBERS, NO_NUMBERS, NO_NUMBERS, np.zeros((0, 3)), NO_NUMBERS
)


class NavBlock(NamedTuple):
    """n estimates of one foot, as nav_msgs/Odometry wants them: pose in the world frame, twist in the foot frame."""

    stamp_ns: Stamps  # (n,)
    position_m: Floats  # (n, 3) in the world frame
    quat_xyzw: Floats  # (n, 4) world from foot
    velocity_mps: Floats  # (n, 3) in the foot frame
    rate_radps: Floats  # (n, 3) in the foot frame, without bias
    pose_covariance: Floats  # (n, 6, 6) x, y, z, rotation about the world's x, y, z
    twist_covariance: Floats  # (n, 6, 6) velocity and rate in the foot frame


class AttitudeBlock(NamedTuple):
    """n orientations of one foot."""

    stamp_ns: Stamps  # (n,)
    quat_xyzw: Floats  # (n, 4) world from foot
    attitude_covariance: Floats  # (n, 3, 3) [rad^2] rotation about the world's x, y, z
    gyro_bias_radps: Floats  # (n, 3) measured = true + bias


@dataclass(frozen=True)
class PoseEstimate:
    """A pose in the world frame, and how well it is known."""

    position_m: Floats  # (3,)
    quat_xyzw: Floats | None  # (4,); None: unknown
    covariance: Floats  # (6, 6) x, y, z, rotation about the world's x, y, z


@dataclass(frozen=True)
class Biases:
    """What a sensor shows too much, and how well that is known."""

    accel_mps2: Floats  # (3,)
    gyro_radps: Floats  # (3,)
    covariance: Floats  # (6, 6) accelerometer, gyro


@dataclass(frozen=True)
class Handover:
    """What one estimator hands to another, so that it can go on from there."""

    stamp_ns: int
    pose: PoseEstimate
    biases: Biases | None  # None: unknown


NOT_NUMBERED = (-1, -1)


@dataclass(frozen=True)
class StepEvent:
    """One step of one foot: from the end of one stance to the end of the next."""

    index: int  # 1, 2, 3 ...
    start_ns: int
    stamp_ns: int
    position_m: Floats  # (3,)
    displacement_m: Floats  # (3,)
    displacement_covariance_m2: Floats  # (3, 3)
    yaw_rad: float  # of the foot while it stands
    yaw_sd_rad: float
    answer_due_ns: int = NO_STAMP  # the filter waits here for the heading observation; NO_STAMP: it asks for none
    sample_numbers: tuple[int, int] = NOT_NUMBERED  # of its first and its last sample, as the filter counts them
    position_covariance_m2: Floats | None = None  # (3, 3); None: unknown

    @property
    def length_m(self) -> float:
        """Horizontal length."""
        return float(np.hypot(self.displacement_m[0], self.displacement_m[1]))

    @property
    def heading_rad(self) -> float:
        """Direction of the displacement, counter-clockwise from x."""
        return float(np.arctan2(self.displacement_m[1], self.displacement_m[0]))

    @property
    def heading_sd_rad(self) -> float:
        """Standard deviation of the heading, at most pi: a step on the spot has none."""
        across = np.array([-np.sin(self.heading_rad), np.cos(self.heading_rad)])
        variance_m2 = float(across @ self.displacement_covariance_m2[:2, :2] @ across)
        return min(np.pi, float(np.sqrt(variance_m2)) / max(self.length_m, 1e-6))


class HeadingSource(Enum):
    """Who knows better; the values are those of pdr_msgs/HeadingObservation."""

    NONE = 0
    STRAIGHT_WALK = 1
    BUILDING = 2
    OTHER_FOOT = 3
    MAGNETOMETER = 4
    EXTERNAL = 5


@dataclass(frozen=True)
class PositionError:
    """By how much a place is off."""

    error_m: Floats  # (3,) estimated minus true, world frame
    covariance_m2: Floats  # (3, 3)


@dataclass(frozen=True)
class HeadingObservation:
    """The answer to one step event: each gets exactly one, an empty one where there is nothing to say."""

    step_index: int
    step_ns: int  # stamp of the step event
    applies_from_ns: int  # the first sample at or after it takes the observation; not before the step's answer_due_ns
    source: HeadingSource  # NONE: nothing is said of the heading
    yaw_error_rad: float  # estimated minus true: by how much the track is turned too far, counter-clockwise
    yaw_error_sd_rad: float
    position: PositionError | None = None  # of the foot where it stands; None: nothing is said of it

    @property
    def empty(self) -> bool:
        """Nothing is said."""
        return self.source is HeadingSource.NONE and self.position is None


def empty_answer(step: StepEvent) -> HeadingObservation:
    """Return the answer to a step that says nothing."""
    return HeadingObservation(step.index, step.stamp_ns, step.answer_due_ns, HeadingSource.NONE, 0.0, 0.0)


class FilterMode(Enum):
    """What the filter is doing; the values are those of pdr_msgs/FilterHealth."""

    ALIGNING = 0
    NAVIGATING = 1
    COASTING = 2  # across a gap, or without the gyro


class FieldUse(Enum):
    """What the magnetic field tells the filter; the values are those of pdr_msgs/FilterHealth."""

    NONE = 0
    CHANGE = 1  # the gyro bias, by how the field changes in a stance
    HEADING = 2  # the heading too: the field is clean


@dataclass(frozen=True)
class FilterHealth:
    """How far the filter can be trusted now."""

    mode: FilterMode
    stamp_ns: int
    quality: float  # 0 (lost) .. 1
    samples: int
    accepted: int  # zero-velocity updates
    contradicted: int
    gaps: int
    resets: int
    since_zero_velocity_s: float
    normalised_innovation: float
    position_sd_m: float  # horizontal, larger axis
    height_sd_m: float
    velocity_sd_mps: float  # largest axis
    tilt_sd_rad: float  # larger axis
    yaw_sd_rad: float
    gyro_bias_radps: Floats  # (3,)
    gyro_bias_sd_radps: Floats  # (3,)
    accel_bias_mps2: Floats  # (3,)
    accel_bias_sd_mps2: Floats  # (3,)
    gravity_mps2: float
    field_use: FieldUse
    north_rad: float  # azimuth of the magnetic field in the world frame
    north_sd_rad: float  # pi: unknown


class TruthKind(Enum):
    """What is known of where the foot really was."""

    POSITION = "position"  # at many stamps
    STRIDES = "strides"  # at the end of every stance, without stamps; the first row is the start
    CLOSED_LOOP = "closed_loop"  # only that the walk ends where it began


@dataclass(frozen=True)
class Truth:
    """Where the foot really was, in any frame whose z points up."""

    kind: TruthKind
    stamp_ns: Stamps  # (n,) for POSITION, else (0,)
    position_m: Floats  # (n, 3) for POSITION; (strides + 1, 2) for STRIDES; else (0, 3)
    points_m: Floats | None = None  # (n, points, 3) where POSITION is the mean of several, as heel and toe


class Level(Enum):
    """How bad a notice is; the values are those of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


@dataclass(frozen=True)
class Notice:
    """What a stage has to say to a person: one per kind, with how often it happened."""

    level: Level
    kind: str
    text: str
    count: int
    first_stamp_ns: int


def length(block: tuple) -> int:
    """Return the number of samples in a block."""
    first = block[0]
    return length(first) if isinstance(first, tuple) else len(first)


def part(block: Block, start: int, stop: int | None = None) -> Block:
    """Return the samples start:stop of a block."""
    columns = (part(c, start, stop) if isinstance(c, tuple) else c[start:stop] for c in block)
    return type(block)(*columns)


def picked(block: Block, rows: NDArray[np.integer]) -> Block:
    """Return the samples at rows, (n,), of a block."""
    return type(block)(*(picked(c, rows) if isinstance(c, tuple) else c[rows] for c in block))


def joined(blocks: list[Block]) -> Block:
    """Return the blocks, one after the other, as one block."""
    columns = zip(*blocks, strict=True)
    return type(blocks[0])(*(joined(list(c)) if isinstance(c[0], tuple) else np.concatenate(c) for c in columns))
