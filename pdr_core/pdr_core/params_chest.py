"""The parameters of the chest card."""

from dataclasses import dataclass

from pdr_core.parameter import parameter

METHODS = ("improved", "traditional", "inertial")


@dataclass(frozen=True)
class ChestParams:
    """Navigation with a card on the chest (Cheng section 3)."""

    method: str = parameter(
        "improved",
        "what corrects the tilt while walking: the mean force of a step, the force of every sample, or nothing",
        choices=METHODS,
        source="Cheng Table 2: ICFWSLC, TCFWSLC, PIWSLCS",
    )
    static_window_s: float = parameter(
        0.5, "a rest is judged over so long", unit="s", bounds=(0.1, 5.0), source="Cheng eq. 1 has no figure"
    )
    static_accel_mps2: float = parameter(
        0.2,
        "rest: mean distance of the force's magnitude from that of gravity",
        unit="m/s^2",
        bounds=(0.01, 5.0),
        source="Cheng eq. 1 has no figure; standing people show 0.04",
    )
    static_gyro_radps: float = parameter(
        0.035,
        "rest: mean magnitude of the rate",
        unit="rad/s",
        bounds=(0.001, 1.0),
        source="Cheng eq. 1 has no figure; 2 deg/s, standing people show 0.3",
    )
    static_correction: str = parameter(
        "fit",
        "what a rest tells: the means of rate and force, or both together, by which a swaying person is seen to sway",
        choices=("mean", "fit"),
        source="mean: Cheng eq. 2-3; fit: chest/rest_fit.py",
    )
    sway_sd_rad: float = parameter(
        0.003,
        "how much a standing person sways: it limits what a mean tells of the gyro",
        unit="rad",
        bounds=(0.0, 0.1),
        source="0.0368 m/s^2 of the trunk: Neville et al. 2015",
    )
    bias_wander_radps: float = parameter(
        0.0007,
        "deviation of what the gyro's bias wanders by",
        unit="rad/s",
        bounds=(0.0, 0.1),
        source="0.04 deg/s: Cheng Table 1",
    )
    feedback_per_s: float = parameter(
        0.52,
        "K of the improved method: by how much of a tilt error the attitude is turned back in a second",
        unit="1/s",
        bounds=(0.0, 1.0),
        source="least attitude error of the real loop, see docs/chest.md",
    )
    traditional_feedback_per_s: float = parameter(
        0.005,
        "K of the traditional method",
        unit="1/s",
        bounds=(0.0, 10.0),
        source="least attitude error of the real loop, see docs/chest.md",
    )
    step_swing_mps2: float = parameter(
        0.4,
        "a step: the low-passed magnitude of the force falls so far below gravity, and rises above it again",
        unit="m/s^2",
        bounds=(0.01, 10.0),
    )
    step_lowpass_hz: float = parameter(
        3.0, "corner of that low-pass", unit="Hz", bounds=(0.5, 20.0), source="people make 1.5 to 2.5 steps a second"
    )
    step_min_s: float = parameter(0.3, "no step is shorter", unit="s", bounds=(0.05, 2.0))
    step_max_s: float = parameter(1.2, "no step is longer: after that the walk has ended", unit="s", bounds=(0.3, 5.0))
    start_steps: int = parameter(
        2, "the steps of a start, in which nothing is fed back", bounds=(0, 10), source="Miff et al. 2005"
    )
    uniform_accel_mps2: float = parameter(
        0.35,
        "uniform motion: the mean level force of a step is less",
        unit="m/s^2",
        bounds=(0.01, 5.0),
        source="2 deg of tilt",
    )
    steady_steps: int = parameter(
        4, "after so many steps in a row that are not uniform the tilt is wrong, not the motion", bounds=(1, 50)
    )
    step_length: str = parameter(
        "first",
        "what the solved length of a step is compared with: the first steps, a model learnt from them, or nothing",
        choices=("first", "model", "none"),
        source="Cheng eq. 13",
    )
    step_direction: str = parameter(
        "chest",
        "where such a step goes: where it was solved to go, or where the chest points: people do not walk sideways",
        choices=("chest", "solved"),
        source="Cheng section 2.1; his eq. 13 leaves it as solved",
    )
    first_steps: int = parameter(
        3, "so many uniform steps after a rest are the first ones", bounds=(1, 50), source="Cheng has 1"
    )
    step_share: float = parameter(
        0.65,
        "s: by how much of the difference a step is moved towards the first length",
        bounds=(0.0, 1.0),
        source="Cheng eq. 13, derived in chest/step_length.py",
    )
    step_sd_m: float = parameter(
        0.02,
        "how well a first step is solved, and with it what a step should be",
        unit="m",
        bounds=(1e-4, 1.0),
        source="simulated walks",
    )
    level_ground: bool = parameter(True, "the walk is level: a step does not change the height", source="Cheng 2.1")
    tilt_sd_rad: float = parameter(
        0.005, "tilt error for the standard deviations of the estimate", unit="rad", bounds=(0.0, 0.5)
    )
