"""The parameters of the estimator of one foot: stance detection and filter."""

from dataclasses import dataclass

from pdr_core.parameter import parameter


@dataclass(frozen=True)
class StanceParams:
    """Stance detection: GLRT, relative threshold, soft rest test."""

    detector: str = parameter(
        "adaptive",
        "what tells a standing foot; adaptive: the GLRT with a threshold relative to the last swing",
        choices=(
            "adaptive",
            "glrt",
            "angular_rate_energy",
            "acceleration_moving_variance",
            "acceleration_magnitude",
            "mbgtd",
            "three_conditions",
        ),
    )
    time_gate: str = parameter(
        "none",
        "what tells stances from moments that only look like it, by their duration",
        choices=("none", "gait_phases", "kmeans"),
        source="Gui section 3, Qiu section 2.3",
    )
    window_s: float = parameter(
        0.035, "length of the centred window of the GLRT", unit="s", bounds=(0.0, 1.0), source="Gui eq. 8, W"
    )
    accel_sd_mps2: float = parameter(
        0.1, "accelerometer noise in the GLRT", unit="m/s^2", bounds=(1e-4, 10.0), source="Gui eq. 8, sigma_f"
    )
    gyro_sd_radps: float = parameter(
        0.017, "gyro noise in the GLRT", unit="rad/s", bounds=(1e-5, 1.0), source="Gui eq. 8, sigma_omega"
    )
    memory_s: float = parameter(
        0.9,
        "the threshold follows the largest statistic of so much time: longer than a stance",
        unit="s",
        bounds=(0.05, 60.0),
        source="measured on real walks",
    )
    relative_share: float = parameter(
        0.022,
        "a foot stands where the statistic is at most this share of the largest; 0: threshold_min alone counts",
        bounds=(0.0, 1.0),
        source="measured on real walks: 1/45",
    )
    threshold_min: float = parameter(
        30.0, "the threshold is at least this", bounds=(1e-3, 1e9), source="measured on real walks"
    )
    threshold_max: float = parameter(
        1e5, "the threshold is at most this, unless threshold_min is larger", bounds=(1e-3, 1e12)
    )
    quiet_max: float = parameter(
        300.0,
        "the noise of a resting sensor counts as this at most; 0: noise does not raise the threshold",
        bounds=(0.0, 1e6),
    )
    still_sd_mps: float = parameter(
        0.005, "how still a standing foot is at best", unit="m/s", bounds=(1e-5, 10.0), source="measured on real walks"
    )
    sd_per_root_mps: float = parameter(
        0.0022,
        "how still it is, per square root of the statistic",
        unit="m/s",
        bounds=(0.0, 10.0),
        source="measured on real walks",
    )
    rest_moving_radps: float = parameter(
        0.5,
        "a mean rate over this is a moving foot",
        unit="rad/s",
        bounds=(0.01, 10.0),
        source="measured on real walks",
    )
    rest_smoothing_s: float = parameter(0.05, "time over which that mean is taken", unit="s", bounds=(0.0, 1.0))
    rest_guard_s: float = parameter(
        0.1, "time before and after movement that is left out of a rest", unit="s", bounds=(0.0, 2.0)
    )
    rest_shortest_s: float = parameter(0.4, "shortest window of the first rest", unit="s", bounds=(0.05, 10.0))
    rest_longest_s: float = parameter(3.0, "longest window of a rest", unit="s", bounds=(0.1, 60.0))
    rest_later_s: float = parameter(
        2.0, "shortest window of a later rest: longer than any stance of a walk", unit="s", bounds=(0.1, 60.0)
    )
    rest_floor_radps: float = parameter(
        8.7e-4,
        "a rest never tells the gyro bias better than this",
        unit="rad/s",
        bounds=(0.0, 1.0),
        source="0.05 deg/s",
    )
    rest_turn_rad: float = parameter(
        5.2e-4, "a resting foot may turn steadily by this", unit="rad", bounds=(0.0, 1.0), source="0.03 deg"
    )
    rest_drift_radps2: float = parameter(
        1.7e-4,
        "a bias may drift so fast: late windows of a rest count more",
        unit="rad/s^2",
        bounds=(0.0, 1.0),
        source="0.01 deg/s a second",
    )


@dataclass(frozen=True)
class FilterParams:
    """The error-state Kalman filter."""

    samples: str = parameter(
        "points",
        "a sample is the value at its stamp, or what the sensor integrated (means) or averaged since the one before",
        choices=("points", "means", "averages"),
    )
    heading_states: bool = parameter(
        True,
        "estimate yaw error and gyro bias; false: the filter of 11 states, which takes heading observations whole",
        source="paper 004 eq. 1-3",
    )
    alignment_s: float = parameter(
        0.1, "the foot is levelled by the mean of this first time", unit="s", bounds=(0.0, 60.0), source="Gui eq. 1-2"
    )
    initial_yaw_source: str = parameter(
        "given",
        "yaw at the start: initial_yaw_rad, or by the calibrated magnetometer, counter-clockwise from east",
        choices=("given", "magnetometer"),
        source="Gui section 5.2",
    )
    initial_yaw_rad: float = parameter(
        0.0, "yaw at the start, where the field does not give it", unit="rad", bounds=(-3.15, 3.15)
    )
    gravity_source: str = parameter(
        "rest",
        "gravity of the place, or all that the accelerometer shows in the first rest, its bias along the vertical too",
        choices=("rest", "place"),
        source="a data sheet's 0.1 m/s^2 of bias, taken for gravity, makes each stride 0.4 % too long",
    )
    zero_velocity_sd_mps: float = parameter(
        0.02,
        "how still a standing foot is, where the detector does not say",
        unit="m/s",
        bounds=(1e-5, 10.0),
        source="Gui eq. 22, Zhou R_v",
    )
    contact_height_m: float = parameter(
        0.08,
        "height of the sensor above the point about which a standing foot rolls; 0: it does not roll",
        unit="m",
        bounds=(0.0, 1.0),
        source="measured on real walks",
    )
    huber: float = parameter(
        5.0,
        "normalised innovation squared up to which a zero-velocity update has its full weight",
        bounds=(0.1, 1e9),
        source="Huber 1964; measured on real walks",
    )
    gate: float = parameter(
        30.0, "normalised innovation squared beyond which a stance contradicts the estimate", bounds=(1.0, 1e9)
    )
    gate_release_s: float = parameter(
        0.1, "after so long in contradicting stances it is the estimate that is doubted", unit="s", bounds=(0.0, 10.0)
    )
    step_merge_s: float = parameter(
        0.3,
        "interruptions of a stance up to this belong to it",
        unit="s",
        bounds=(0.0, 5.0),
        source="measured on real walks",
    )
    step_min_m: float = parameter(
        0.05,
        "a foot that never is so far from where it stood takes no step",
        unit="m",
        bounds=(0.0, 1.0),
        source="half of the shortest shuffle among real walks",
    )
    step_turn_min_rad: float = parameter(
        0.35, "unless it turns by so much", unit="rad", bounds=(0.0, 3.15), source="20 deg: more than a wobble"
    )
    level_ground: bool = parameter(
        False, "a foot that stands at nearly the height of the floor stands on it: for walks in buildings, not on ramps"
    )
    floor_limit_m: float = parameter(
        0.08,
        "a foot that stands so much higher or lower than the floor is on another one",
        unit="m",
        bounds=(0.0, 1.0),
        source="half a riser, which is 0.15 to 0.20 m",
    )
    floor_sd_m: float = parameter(
        0.01,
        "how much the heights of a foot differ that stands on one floor",
        unit="m",
        bounds=(1e-4, 1.0),
        source="measured on real walks: 0.004 to 0.021, median 0.008",
    )
    magnetometer: str = parameter(
        "auto",
        "what the field may tell: the gyro bias, by its change in a stance; auto: the heading too, where it is clean",
        choices=("auto", "change", "off"),
    )
    field_offset_sd_tesla: float = parameter(
        1e-5,
        "what a turning foot sees change of the field by the magnetometer's offset and by iron near it, a radian",
        unit="T",
        bounds=(0.0, 1e-3),
        source="measured on real walks",
    )
    field_gate: float = parameter(
        12.0,
        "normalised innovation squared beyond which the change of a field is not believed",
        bounds=(1.0, 1e9),
        source="chi-square, 3 degrees of freedom, 99.3 %",
    )
    field_norm_tolerance: float = parameter(
        0.03, "share by which the field's strength may differ from place to place in a clean field", bounds=(0.0, 1.0)
    )
    field_dip_tolerance_rad: float = parameter(
        0.035, "angle by which its dip may differ", unit="rad", bounds=(0.0, 1.6), source="2 deg"
    )
    field_azimuth_tolerance_rad: float = parameter(
        0.1, "angle by which its azimuth may differ", unit="rad", bounds=(0.0, 3.15), source="6 deg"
    )
    field_heading_gate: float = parameter(
        6.6,
        "normalised innovation squared beyond which the azimuth of a clean field is not believed",
        bounds=(1.0, 1e9),
        source="chi-square, 1 degree of freedom, 99 %",
    )
    field_heading_sd_rad: float = parameter(
        0.07, "noise of the direction of a clean field at one place", unit="rad", bounds=(1e-4, 3.15), source="4 deg"
    )
    heading_feedback: bool = parameter(
        False, "every step waits for its heading observation: set it where a node or stage gives them"
    )
    heading_due_s: float = parameter(
        0.1, "so long after a step is known its heading observation applies", unit="s", bounds=(0.0, 5.0)
    )
    gap_speed_mps: float = parameter(1.5, "speed that a person may have in a gap", unit="m/s", bounds=(0.0, 20.0))
    gap_rate_radps: float = parameter(0.5, "rate at which a foot may turn in a gap", unit="rad/s", bounds=(0.0, 20.0))
    accel_bias_walk: float = parameter(
        1e-5, "random walk of the accelerometer bias", unit="m/s^2/sqrt(s)", bounds=(0.0, 1.0), source="Gui eq. 16"
    )
    gyro_bias_walk: float = parameter(
        1e-6, "random walk of the gyro bias", unit="rad/s/sqrt(s)", bounds=(0.0, 1.0), source="Gui eq. 15"
    )
    bias_correlation_s: float = parameter(
        1e7,
        "correlation time of the biases, 1/beta: a bias that a rest has shown is kept",
        unit="s",
        bounds=(1.0, 1e9),
        source="about 2 (initial deviation / walk)^2: with it Gui eq. 15-16 keep the initial variance",
    )
    initial_position_sd_m: float = parameter(0.001, "at the start", unit="m", bounds=(0.0, 1e3))
    initial_velocity_sd_mps: float = parameter(0.01, "at the start", unit="m/s", bounds=(0.0, 10.0))
    initial_tilt_sd_rad: float = parameter(0.03, "after levelling", unit="rad", bounds=(0.0, 3.15))
    initial_yaw_sd_rad: float = parameter(0.001, "at the start", unit="rad", bounds=(0.0, 3.15))
    initial_accel_bias_sd_mps2: float = parameter(0.02, "what the sensor may bring", unit="m/s^2", bounds=(0.0, 10.0))
    initial_gyro_bias_sd_radps: float = parameter(
        0.0035, "what the sensor may bring: 0.2 deg/s", unit="rad/s", bounds=(0.0, 1.0), source="measured on real walks"
    )
