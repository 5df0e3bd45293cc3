"""The parameters of dead reckoning by strides, with the gyro off."""

from dataclasses import dataclass

from pdr_core.parameter import parameter

MEASURED = "measured on real walks"


@dataclass(frozen=True)
class DeadReckoningParams:
    """Heading deviation, stands of the foot, turns from the accelerometer, and how the track's error grows."""

    deviation_shortest_m: float = parameter(
        0.4,
        "a shorter stride does not tell the walking direction",
        unit="m",
        bounds=(0.0, 3.0),
        source="half a stride of a stroll: such are the first and the last",
    )
    deviation_scatter_rad: float = parameter(
        0.06,
        "how far the direction of a stride is off the foot's usual one",
        unit="rad",
        bounds=(1e-4, 1.0),
        source="measured on real walks: 2.4 to 3.7 deg in straight strides",
    )
    turn_scatter: float = parameter(
        0.2,
        "and in turns besides: this share of the turn",
        bounds=(0.0, 1.0),
        source="measured on real walks: the best share of the turn lies between 0.5 and 0.75",
    )
    deviation_walk_rad: float = parameter(
        0.002,
        "random walk of the heading deviation",
        unit="rad/sqrt(s)",
        bounds=(0.0, 1.0),
        source="Zhou eq. 18, w_2; 1.3 deg in two minutes: the ranges of Zhou's Table 4",
    )
    deviation_rate_walk_radps: float = parameter(
        1e-5,
        "random walk of its rate",
        unit="rad/s/sqrt(s)",
        bounds=(0.0, 1.0),
        source="Zhou eq. 17, w_1; a gait hardly drifts",
    )
    deviation_gate: float = parameter(
        9.0,
        "normalised innovation squared from which a stride counts less",
        bounds=(1.0, 1e9),
        source="3 standard deviations",
    )
    stand_shortest_s: float = parameter(
        0.16, "a foot that is still for less does not stand", unit="s", bounds=(0.02, 1.0), source=MEASURED
    )
    stand_window_s: float = parameter(
        0.15, "of a stand counts the stillest time of this length", unit="s", bounds=(0.02, 1.0)
    )
    stand_known_s: float = parameter(
        0.25,
        "after so long a stand is judged, though it goes on",
        unit="s",
        bounds=(0.05, 10.0),
        source="soon enough for the gyro to wake within it",
    )
    swing_shortest_s: float = parameter(
        0.3, "a shorter movement is no stride", unit="s", bounds=(0.05, 2.0), source=MEASURED
    )
    impulse_share: float = parameter(
        0.75,
        "share of the swing over which the acceleration across the walk is summed up",
        bounds=(0.1, 1.0),
        source="measured on real walks: flat from 0.6 to 1",
    )
    turn_sd_rad: float = parameter(
        0.26,
        "how far the turn that an impulse tells may be off",
        unit="rad",
        bounds=(0.01, 3.15),
        source="measured on real walks: 7 to 20 deg",
    )
    turn_sd_share: float = parameter(
        0.3,
        "and in turns besides: this share of the turn",
        bounds=(0.0, 1.0),
        source=MEASURED,
    )
    suspicion_rad: float = parameter(
        0.22,
        "an accelerometer that shows a turn by more wakes the gyro",
        unit="rad",
        bounds=(0.0, 3.15),
        source="measured on real walks: as good a track from 0.12 to 0.35, with less gyro",
    )
    held_turn_sd_rad: float = parameter(
        0.61,
        "how far a person turns in a stride of which nobody knows anything",
        unit="rad",
        bounds=(0.0, 3.15),
        source="35 deg, root mean square; measured on real walks in buildings: 24 to 43 deg",
    )
    field_disturbed_sd_rad: float = parameter(
        0.26,
        "in a building the fields of places differ at least by so much, whatever the first places show",
        unit="rad",
        bounds=(0.0, 3.15),
        source="measured on real walks: 9 to 29 deg, and north moves by up to 17 deg within a walk",
    )
    field_common: float = parameter(
        0.5,
        "share of it by which the fields of all places are off together",
        bounds=(0.0, 2.0),
        source="measured on real walks: flat from 0.3 to 0.7",
    )
    field_wander: float = parameter(
        0.2,
        "share of that error that is new with every stride: at 0.2 half of it is another after 34 strides",
        bounds=(0.0, 1.0),
        source="measured on real walks: flat from 0.1 to 0.3",
    )
    length_scale_sd: float = parameter(
        0.02,
        "share by which all step lengths of a model are too long or too short together",
        bounds=(0.0, 1.0),
        source="measured on real walks: 2 to 3 % of the distance",
    )
    climb_sd_m: float = parameter(0.05, "how much a stride may climb: nobody measures it", unit="m", bounds=(0.0, 1.0))
    tilt_sd_rad: float = parameter(
        0.05, "how differently the foot stands from place to place", unit="rad", bounds=(0.0, 1.6), source=MEASURED
    )
    odom_rate_hz: float = parameter(50.0, "rate of the estimates between steps", unit="Hz", bounds=(1.0, 1e3))
