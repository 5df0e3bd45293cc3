"""The parameters of the family of stance detectors, each with its own window and threshold, and of the time gates."""

from dataclasses import dataclass

from pdr_core.parameter import parameter

MEASURED = "measured on real walks"


@dataclass(frozen=True)
class DetectorParams:
    """The detectors beside the default one and the time gates; `stance.detector`, `stance.time_gate` pick one."""

    glrt_window_s: float = parameter(
        0.035, "length of the centred window of the GLRT", unit="s", bounds=(0.0, 1.0), source="Gui eq. 8, W"
    )
    glrt_threshold: float = parameter(
        6000.0, "a foot stands where its statistic is at most this", bounds=(1e-3, 1e9), source=MEASURED
    )
    angular_rate_energy_window_s: float = parameter(
        0.035, "length of the centred window of the angular rate energy", unit="s", bounds=(0.0, 1.0)
    )
    angular_rate_energy_threshold: float = parameter(
        1.4,
        "a foot stands where its mean square rate is at most this",
        unit="rad^2/s^2",
        bounds=(1e-9, 1e9),
        source=MEASURED,
    )
    acceleration_moving_variance_window_s: float = parameter(
        0.1, "length of the centred window of the acceleration moving variance", unit="s", bounds=(0.0, 1.0)
    )
    acceleration_moving_variance_threshold: float = parameter(
        0.7,
        "a foot stands where the variance of its specific force is at most this",
        unit="m^2/s^4",
        bounds=(1e-9, 1e9),
        source=MEASURED,
    )
    acceleration_magnitude_window_s: float = parameter(
        0.075, "length of the centred window of the acceleration magnitude", unit="s", bounds=(0.0, 1.0)
    )
    acceleration_magnitude_threshold: float = parameter(
        0.1,
        "a foot stands where the mean square of |a| - g is at most this",
        unit="m^2/s^4",
        bounds=(1e-9, 1e9),
        source=MEASURED,
    )
    mbgtd_window_s: float = parameter(0.075, "length of the centred window of the MBGTD", unit="s", bounds=(0.0, 1.0))
    mbgtd_threshold: float = parameter(
        1.4,
        "a foot stands where the longest mean edge of a cut is at most this",
        unit="m/s^2",
        bounds=(1e-9, 1e9),
        source=MEASURED,
    )
    three_conditions_window_s: float = parameter(
        0.035, "length of the centred window of the three conditions", unit="s", bounds=(0.0, 1.0), source="Qiu W"
    )
    three_conditions_force_threshold: float = parameter(
        0.2,
        "a foot stands where |a| differs from g by at most this share of g",
        bounds=(1e-9, 1e9),
        source="Qiu eq. 22, lambda_1; " + MEASURED,
    )
    three_conditions_variance_threshold: float = parameter(
        10.0,
        "and the variance of |a| is at most this",
        unit="m^2/s^4",
        bounds=(1e-9, 1e9),
        source="Qiu eq. 22, lambda_2; " + MEASURED,
    )
    three_conditions_rate_threshold: float = parameter(
        1.4,
        "and the mean square rate is at most this",
        unit="rad^2/s^2",
        bounds=(1e-9, 1e9),
        source="Qiu eq. 22, lambda_3; " + MEASURED,
    )
    gait_phases_toe_off_s: float = parameter(
        0.05, "a foot that moves for less has not left the ground", unit="s", bounds=(0.0, 1.0), source="Gui fig. 2"
    )
    gait_phases_swing_min_s: float = parameter(
        0.3, "shortest time from toe-off to heel strike", unit="s", bounds=(0.0, 2.0), source=MEASURED
    )
    gait_phases_dip_max_s: float = parameter(
        0.1,
        "a rest in the swing of this length is a stance after all",
        unit="s",
        bounds=(0.0, 2.0),
        source="Gui fig. 3",
    )
    kmeans_longest_s: float = parameter(
        0.1,
        "a rest of this length is a stance, whatever the clusters",
        unit="s",
        bounds=(0.0, 2.0),
        source=MEASURED,
    )
    kmeans_lockout_s: float = parameter(
        0.4, "after so long without a stance the next rest is one", unit="s", bounds=(0.0, 60.0), source=MEASURED
    )
