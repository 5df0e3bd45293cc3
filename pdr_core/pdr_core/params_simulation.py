"""The parameters of the simulator."""

from dataclasses import dataclass

from pdr_core.parameter import parameter


@dataclass(frozen=True)
class SimulationParams:
    """The simulated walk and the sensor that feels it."""

    motion: str = parameter(
        "gui",
        "how the foot moves: as Gui prints it, or smoothly; or a card on the chest",
        choices=("gui", "smooth", "chest"),
        source="Gui section 5.1; chest: simulation/chest_person.py",
    )
    walk: str = parameter(
        "rectangle",
        "the walk; gui knows the first four, chest the first three",
        choices=(
            "rectangle",
            "straight",
            "still",
            "campus",
            "curve",
            "corridor",
            "stairs",
            "run",
            "mixed",
            "qiu_rectangle",
            "track",
            "stair_climb",
            "octagon",
            "octagon_run",
            "transitions",
        ),
        source="campus: Gui figure 6; the last three: Zhou section 5, those before: Qiu section 3",
    )
    walk_length_m: float = parameter(36.0, "length of the walk, without its stairs", unit="m", bounds=(0.0, 1e5))
    pace: float = parameter(
        1.0, "speed of the smooth foot beside its usual one; 2: a run is a sprint", bounds=(0.5, 3.0)
    )
    tester: str = parameter(
        "none",
        "who walks smoothly: the usual person, whose strides are all alike, or one of Zhou's testers",
        choices=("none", "a", "b", "c", "d"),
        source="Zhou Table 4, simulation/testers.py",
    )
    heading_deviation_rad: float = parameter(
        0.0,
        "smooth foot: walking direction less heading of the foot, counter-clockwise; a right toe outward: positive",
        unit="rad",
        bounds=(-3.15, 3.15),
        source="Zhou eq. 16",
    )
    sensor_model: str = parameter(
        "consumer",
        "the sensor",
        choices=("ideal", "consumer", "g_sensitive", "gui_table_1", "gui_table_1_deg", "qiu_table_1", "icm_20602"),
        source="Gui Table 1, Qiu Table 1, Cheng Table 1",
    )
    sample_rate_hz: float = parameter(200.0, "rate of the sensor", unit="Hz", bounds=(20.0, 4000.0))
    output: str = parameter(
        "points", "a sample is the value at its stamp, or the mean since the one before", choices=("points", "means")
    )
    earth_rate: bool = parameter(False, "the gyro feels the Earth turn", source="Gui eq. 31")
    mounting_roll_rad: float = parameter(
        0.0, "roll of the sensor on the foot, fixed axes", unit="rad", bounds=(-3.15, 3.15)
    )
    mounting_pitch_rad: float = parameter(0.0, "pitch of the sensor on the foot", unit="rad", bounds=(-3.15, 3.15))
    mounting_yaw_rad: float = parameter(0.0, "yaw of the sensor on the foot", unit="rad", bounds=(-3.15, 3.15))
    gyro_range_radps: float = parameter(
        0.0, "angular rate at which the gyro clips; 0: as its model does", unit="rad/s", bounds=(0.0, 200.0)
    )
    accel_range_mps2: float = parameter(
        0.0, "specific force at which the accelerometer clips; 0: as its model does", unit="m/s^2", bounds=(0.0, 5e3)
    )
    shock_mps2: float = parameter(0.0, "strongest shock at heel strike", unit="m/s^2", bounds=(0.0, 500.0))
    magnetometer: bool = parameter(False, "the sensor measures the magnetic field too")
    magnetometer_rate_hz: float = parameter(
        0.0, "rate of the magnetometer; samples between have no field; 0: as the rest", unit="Hz", bounds=(0.0, 4000.0)
    )
    field_norm_tesla: float = parameter(50e-6, "strength of the Earth's field", unit="T", bounds=(0.0, 1e-3))
    field_dip_deg: float = parameter(
        60.0, "angle of the Earth's field below the horizon", unit="deg", bounds=(-90.0, 90.0)
    )
    field_declination_deg: float = parameter(
        0.0, "angle of magnetic north east of the world's y", unit="deg", bounds=(-180.0, 180.0)
    )
    indoor_field: float = parameter(
        0.0,
        "strength of the iron below the floor beside the Earth's field; 0.25: norm +-20 %, azimuth +-20 deg",
        bounds=(0.0, 2.0),
    )
    disturbance_tesla: float = parameter(
        0.0, "strength of a level field that is switched on for some time", unit="T", bounds=(0.0, 1e-2)
    )
    disturbance_azimuth_deg: float = parameter(
        0.0, "its direction, counter-clockwise from the world's x", unit="deg", bounds=(-180.0, 180.0)
    )
    disturbance_start_s: float = parameter(0.0, "when it is switched on", unit="s", bounds=(0.0, 1e6))
    disturbance_s: float = parameter(10.0, "how long it stays on", unit="s", bounds=(0.0, 1e6))
    foot: str = parameter(
        "single", "what the driver plays: a foot alone, or one of both feet", choices=("single", "left", "right")
    )
    chest_speed_mps: float = parameter(
        0.0,
        "chest: speed of the person; 0: each seed has its own",
        unit="m/s",
        bounds=(0.0, 3.0),
        source="1.0 to 1.5 m/s: Cheng section 4",
    )
    start_ns: int = parameter(0, "stamp of the driver's first sample; 0: now", unit="ns", bounds=(0, 2**62))
    feet_apart_m: float = parameter(
        0.2, "both feet: distance between their sensors across the walk", unit="m", bounds=(0.05, 1.0)
    )
    toe_out_rad: float = parameter(
        0.12,
        "both feet: angle by which each points outward",
        unit="rad",
        bounds=(-0.8, 0.8),
        source="7 deg: Perry, Gait Analysis (1992)",
    )
    double_support: float = parameter(
        0.2,
        "both feet: share of a stride in which both are on the ground; a run has none",
        bounds=(0.0, 0.5),
        source="Perry (1992): twice 10 %",
    )
    placement_sd_m: float = parameter(
        0.018,
        "both feet, and a tester's: how far each comes down from where it should, along and across",
        unit="m",
        bounds=(0.0, 0.1),
        source="step width varies by 2.5 cm, root 2 of it: Skiadopoulos et al. (2020), Table 1",
    )
    feet_errors: str = parameter(
        "mirrored",
        "both feet: the errors of the right sensor are those of the left one in the mirror, or the same",
        choices=("mirrored", "alike"),
        source="paper 004 eq. 4",
    )
    feet_independent: float = parameter(
        0.3, "both feet: share of its errors that each sensor has for itself", bounds=(0.0, 10.0)
    )
    seed: int = parameter(1, "seed of noise, biases, shocks, iron and of where feet come down", bounds=(0, 2**31))
