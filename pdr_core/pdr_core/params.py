"""Every parameter of the suite: one class per stage, one field per parameter.

Those of stance detection and estimators are in the files `params_*.py` beside it. YAML files, ROS declarations and the
tables of the documentation are generated from here (see `parameter.py`).
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any

from pdr_core.parameter import ParameterError, from_mapping, parameter, unknown
from pdr_core.params_attitude import AttitudeParams as AttitudeParams
from pdr_core.params_attitude import DedriftParams as DedriftParams
from pdr_core.params_chest import ChestParams as ChestParams
from pdr_core.params_dead_reckoning import DeadReckoningParams as DeadReckoningParams
from pdr_core.params_detectors import DetectorParams as DetectorParams
from pdr_core.params_external import ExternalParams as ExternalParams
from pdr_core.params_foot import FilterParams as FilterParams
from pdr_core.params_foot import StanceParams as StanceParams
from pdr_core.params_fusion import FusionParams as FusionParams
from pdr_core.params_gait import GaitParams as GaitParams
from pdr_core.params_heading import HeadingParams as HeadingParams
from pdr_core.params_power import PowerParams as PowerParams
from pdr_core.params_simulation import SimulationParams as SimulationParams

CALIBRATE = "`pdr calibrate mag`"
HARD_IRON = "hard iron: what the magnetometer shows without a field"
SOFT_IRON = "soft iron, scale and axes: calibrated = matrix (measured - offset), row and column"


@dataclass(frozen=True)
class IntakeParams:
    """What is known of the sensor: its units, mounting, range, noise and stream."""

    accel_unit: str = parameter("m/s^2", "unit of the incoming acceleration", choices=("m/s^2", "g"))
    gyro_unit: str = parameter("rad/s", "unit of the incoming angular rate", choices=("rad/s", "deg/s"))
    mounting_roll_rad: float = parameter(
        0.0, "roll of the sensor on the foot, fixed axes", unit="rad", bounds=(-3.15, 3.15)
    )
    mounting_pitch_rad: float = parameter(0.0, "pitch of the sensor on the foot", unit="rad", bounds=(-3.15, 3.15))
    mounting_yaw_rad: float = parameter(0.0, "yaw of the sensor on the foot", unit="rad", bounds=(-3.15, 3.15))
    gyro_range_radps: float = parameter(
        34.9, "angular rate at which the gyro saturates", unit="rad/s", bounds=(1.0, 200.0), source="2000 deg/s"
    )
    accel_range_mps2: float = parameter(
        156.9, "specific force at which the accelerometer saturates", unit="m/s^2", bounds=(10.0, 5000.0), source="16 g"
    )
    gyro_noise_density: float = parameter(
        0.001, "noise density of the gyro", unit="rad/s/sqrt(Hz)", bounds=(0.0, 1.0), source="measured on real walks"
    )
    accel_noise_density: float = parameter(
        0.015,
        "noise density of the accelerometer",
        unit="m/s^2/sqrt(Hz)",
        bounds=(0.0, 10.0),
        source="measured on real walks",
    )
    change_noise: float = parameter(
        0.1,
        "share of the change from one sample to the next that the interval between them may hide",
        bounds=(0.0, 1.0),
        source="measured on real walks; a jump at a random moment would be 0.29",
    )
    saturated_gyro_noise_density: float = parameter(
        0.03,
        "noise density where the gyro saturates",
        unit="rad/s/sqrt(Hz)",
        bounds=(0.0, 10.0),
        source="measured on real walks",
    )
    saturated_accel_noise_density: float = parameter(
        1.4, "noise density where the accelerometer saturates", unit="m/s^2/sqrt(Hz)", bounds=(0.0, 100.0)
    )
    clip_smallest_radps: float = parameter(
        4.0,
        "no gyro clips below this rate; a large number switches the repair of clipped rates off",
        unit="rad/s",
        bounds=(0.1, 1e6),
        source="below 250 deg/s, the smallest range sold",
    )
    clip_longest_s: float = parameter(
        0.1, "a sample that may be clipped is held back for at most so long", unit="s", bounds=(0.0, 1.0)
    )
    restart_s: float = parameter(
        1.0, "stamps that jump back by more are a new stream, by less a late sample", unit="s", bounds=(0.01, 3600.0)
    )
    constant_rate_hz: float = parameter(
        0.0,
        "rate at which samples are stamped anew, for drivers that stamp on arrival; 0: the stamps as they come",
        unit="Hz",
        bounds=(0.0, 4000.0),
    )
    mag_unit: str = parameter("T", "unit of the incoming magnetic field", choices=("T", "uT", "nT", "G", "mG"))
    mag_offset_x_tesla: float = parameter(0.0, HARD_IRON, unit="T", bounds=(-0.01, 0.01), source=CALIBRATE)
    mag_offset_y_tesla: float = parameter(0.0, HARD_IRON, unit="T", bounds=(-0.01, 0.01), source=CALIBRATE)
    mag_offset_z_tesla: float = parameter(0.0, HARD_IRON, unit="T", bounds=(-0.01, 0.01), source=CALIBRATE)
    mag_matrix_xx: float = parameter(1.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_xy: float = parameter(0.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_xz: float = parameter(0.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_yx: float = parameter(0.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_yy: float = parameter(1.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_yz: float = parameter(0.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_zx: float = parameter(0.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_zy: float = parameter(0.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_matrix_zz: float = parameter(1.0, SOFT_IRON, bounds=(-10.0, 10.0), source=CALIBRATE)
    mag_sd_tesla: float = parameter(
        5e-7, "noise of one sample of the magnetometer", unit="T", bounds=(1e-10, 1e-3), source="measured on real walks"
    )
    mag_range_tesla: float = parameter(
        4.9e-3, "field at which an axis of the magnetometer saturates", unit="T", bounds=(1e-4, 1.0), source="49 G"
    )


@dataclass(frozen=True)
class PlaceParams:
    """Where on Earth the walk takes place: it gives gravity and the Earth's magnetic field."""

    latitude_deg: float = parameter(45.0, "latitude", unit="deg", bounds=(-90.0, 90.0))
    height_m: float = parameter(0.0, "height above the ellipsoid", unit="m", bounds=(-500.0, 9000.0))
    field_norm_tesla: float = parameter(
        0.0, "strength of the Earth's magnetic field; 0: unknown", unit="T", bounds=(0.0, 1e-4), source=CALIBRATE
    )
    field_dip_deg: float = parameter(
        0.0,
        "by how much the field points below the horizon; counts where its strength is known",
        unit="deg",
        bounds=(-90.0, 90.0),
        source=CALIBRATE,
    )
    field_declination_deg: float = parameter(
        0.0, "by how much the field points east of north; 0: north is magnetic", unit="deg", bounds=(-180.0, 180.0)
    )


@dataclass(frozen=True)
class DriverParams:
    """The driver: which device, how fast."""

    device: str = parameter("simulated", "where the samples come from", choices=("simulated", "replayed"))
    recording: str = parameter("", "path of the recording to replay")
    columns: str = parameter("", "column map of a text recording; empty: the one beside it, or a known format")
    sensor: str = parameter("", "which sensor of the recording; empty: the only one")
    rate_factor: float = parameter(
        1.0, "speed of the replay; 0: as fast as the subscribers take it", bounds=(0.0, 1000.0)
    )
    acknowledge_topic: str = parameter(
        "odom", "as fast as possible: samples count as taken once their estimate appears on this topic"
    )
    lead_samples: int = parameter(
        0, "at a pace: so many samples at most are ahead of acknowledge_topic; 0: any number", bounds=(0, 1000)
    )
    subscribers: int = parameter(1, "the first sample waits for so many subscribers", bounds=(1, 100))
    begins_after: str = parameter("", "the first sample waits for a publisher of each of these topics")
    settling_s: float = parameter(0.05, "what the gyro needs after being switched on", unit="s", bounds=(0.0, 10.0))


LONGEST_PATIENCE_S = 20.0  # even where answers are waited for for ever: one foot may have ended long before the other


@dataclass(frozen=True)
class NodeParams:
    """Frames, streams and habits of the nodes."""

    world_frame: str = parameter("odom", "frame of the estimate", source="REP-105")
    foot_frame: str = parameter("foot", "frame of the foot")
    chest_frame: str = parameter("chest", "chest_pdr: frame of the card on the chest")
    sensor_frame: str = parameter("imu_link", "frame of the sensor", source="REP-145")
    frame_prefix: str = parameter(
        "", "goes before every frame, as alice/ does for one of several people", source="robot_state_publisher"
    )
    autostart: bool = parameter(True, "become active without being told; false: wait for the lifecycle services")
    publish_tf: bool = parameter(False, "broadcast world_frame -> foot_frame; one node at a time may")
    feet: str = parameter("left right", "heading_fusion: the namespaces of the feet of one person, one or two")
    base_frame: str = parameter("base_footprint", "heading_fusion: frame of the person", source="REP-120")
    publish_base_tf: bool = parameter(True, "heading_fusion: broadcast world_frame -> base_frame")
    path_rate_hz: float = parameter(
        1.0, "heading_fusion: a place of the path comes at most so often, by stamps", unit="Hz", bounds=(0.01, 100.0)
    )
    path_places: int = parameter(1000, "heading_fusion: so many of the last places make the path", bounds=(1, 100_000))
    input_reliable: bool = parameter(
        False, "ask the driver for reliable delivery; false connects to any driver", source="REP-2003"
    )
    magnetometer: bool = parameter(
        False, "the sensor has a magnetometer: its field on imu/mag is paired with the samples by stamp"
    )
    field_wait_s: float = parameter(
        0.1, "a sample waits so long, by stamps, for its magnetic field", unit="s", bounds=(0.0, 10.0)
    )
    odom_rate_hz: float = parameter(200.0, "odom comes at most so often, by its stamps", unit="Hz", bounds=(1.0, 4e3))
    answer_timeout_s: float = parameter(
        0.5, "a step's heading observation is waited for so long; 0: for ever", unit="s", bounds=(0.0, 60.0)
    )
    idle_s: float = parameter(
        1.0, "after so long without samples, those that wait for later ones are judged", unit="s", bounds=(0.2, 60.0)
    )
    ends_with: str = parameter(
        "", "idle_s counts only once nobody publishes this topic, as a driver's; empty: from the last sample on"
    )

    @property
    def foot_patience_s(self) -> float:
        """How long one foot waits for another [s]: until shortly before its filter goes on unanswered."""
        return self.answer_timeout_s / 2.0 or LONGEST_PATIENCE_S


@dataclass(frozen=True)
class Params:
    """All of them, by group."""

    intake: IntakeParams = field(default_factory=IntakeParams)
    place: PlaceParams = field(default_factory=PlaceParams)
    stance: StanceParams = field(default_factory=StanceParams)
    detectors: DetectorParams = field(default_factory=DetectorParams)
    filter: FilterParams = field(default_factory=FilterParams)
    attitude: AttitudeParams = field(default_factory=AttitudeParams)
    dedrift: DedriftParams = field(default_factory=DedriftParams)
    fusion: FusionParams = field(default_factory=FusionParams)
    external: ExternalParams = field(default_factory=ExternalParams)
    power: PowerParams = field(default_factory=PowerParams)
    gait: GaitParams = field(default_factory=GaitParams)
    chest: ChestParams = field(default_factory=ChestParams)
    heading: HeadingParams = field(default_factory=HeadingParams)
    dead_reckoning: DeadReckoningParams = field(default_factory=DeadReckoningParams)
    driver: DriverParams = field(default_factory=DriverParams)
    simulation: SimulationParams = field(default_factory=SimulationParams)
    node: NodeParams = field(default_factory=NodeParams)


GROUPS: dict[str, type] = {f.name: f.default_factory for f in fields(Params)}  # type: ignore[misc]


def params_from_mapping(mapping: Mapping[str, Mapping[str, Any]]) -> Params:
    """Build the parameters from {group: {name: value}}; unknown groups and names stop with a ParameterError."""
    for group, values in mapping.items():
        if group not in GROUPS:
            raise unknown("", group, "group of parameters", GROUPS)
        if not isinstance(values, Mapping):
            raise ParameterError(f"{group} = {values!r}: must be a mapping of parameters")
    return Params(**{g: from_mapping(GROUPS[g], values, f"{g}.") for g, values in mapping.items()})


def params_as_mapping(params: Params) -> dict[str, dict[str, Any]]:
    """Return the parameters as {group: {name: value}}."""
    return asdict(params)


def changed(params: Params, group: str, **values: Any) -> Params:
    """Return the parameters with some of a group changed; ParameterError if a value is not allowed."""
    mapping = params_as_mapping(params)
    mapping[group] |= values
    return params_from_mapping(mapping)
