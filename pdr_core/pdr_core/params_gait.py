"""The parameters of what the accelerometer alone tells of a walk: behaviour, strides and their length."""

from dataclasses import dataclass

from pdr_core.parameter import parameter


@dataclass(frozen=True)
class GaitParams:
    """Behaviour recognition, strides and their length from the accelerometer alone (Zhou section 2.2-2.3)."""

    cutoff_hz: float = parameter(
        5.0,
        "cutoff of the low-pass filter on the acceleration; a sensor of 20 Hz shows what is below 10",
        unit="Hz",
        bounds=(1.0, 10.0),
        source="measured on real walks: 3 to 6 Hz do as well",
    )
    filter_s: float = parameter(
        0.3, "length of that filter, which delays everything by half of it", unit="s", bounds=(0.1, 1.0)
    )
    calm_s: float = parameter(
        0.16,
        "so long a foot must be still to be on the ground",
        unit="s",
        bounds=(0.04, 1.0),
        source="measured on real walks: 0.14 to 0.20 s do as well",
    )
    calm_sd_mps2: float = parameter(
        0.6,
        "deviation of the acceleration within that time up to which a foot is still",
        unit="m/s^2",
        bounds=(0.01, 10.0),
        source="measured on real walks: 0.4 to 0.8 do as well",
    )
    calm_mps2: float = parameter(
        2.0,
        "difference to the acceleration of a standing foot up to which it may stand",
        unit="m/s^2",
        bounds=(0.1, 20.0),
        source="measured on real walks: 1.5 to 3 do as well",
    )
    weakest_mps2: float = parameter(
        4.0,
        "what never differs by more is no stride",
        unit="m/s^2",
        bounds=(0.1, 50.0),
        source="measured on real walks: 3 to 5 do as well",
    )
    strong_mps2: float = parameter(
        14.0,
        "after so strong a braking a dip is a stance, though the foot is not still: so in running",
        unit="m/s^2",
        bounds=(1.0, 200.0),
        source="measured on real walks and runs: 12 to 16 do as well",
    )
    dip_share: float = parameter(
        0.35,
        "a dip is at most this share of the braking before it",
        bounds=(0.01, 0.9),
        source="measured on real runs: 0.25 to 0.45 do as well",
    )
    dip_wait_s: float = parameter(
        0.45,
        "a dip counts once so much time has passed since the braking without a stronger one",
        unit="s",
        bounds=(0.1, 1.0),
        source="measured on real walks and runs and simulated stairs: 0.45 to 0.5; a sprint has 0.5 s a stride",
    )
    swing_shortest_s: float = parameter(
        0.5,
        "a dip that comes sooner after the foot was still is between push-off and braking",
        unit="s",
        bounds=(0.0, 2.0),
        source="measured on real walks and runs: such dips come within 0.36 s, stances after 0.62 s",
    )
    standing_s: float = parameter(
        1.2, "a foot that is still for longer stands", unit="s", bounds=(0.5, 10.0), source="longer than any stance"
    )
    stride_longest_s: float = parameter(
        2.5, "a foot that moves for longer without a ground hit does not walk", unit="s", bounds=(1.0, 10.0)
    )
    running_rest_s: float = parameter(
        0.23,
        "a foot that rests for less within a stride runs",
        unit="s",
        bounds=(0.0, 1.0),
        source="measured on real runs: 95 % below 0.22, median 0.04",
    )
    walking_rest_s: float = parameter(
        0.26,
        "and one that rests for longer walks; in between it goes on as before",
        unit="s",
        bounds=(0.0, 1.0),
        source="measured on real walks: 95 % above 0.29, median 0.45",
    )
    swing_direct_mps2: float = parameter(
        0.1,
        "a foot whose mean acceleration over a stride is less above gravity only swings",
        unit="m/s^2",
        bounds=(-5.0, 5.0),
        source="measured: lifting the foot -1.1 to 0.6, median below 0.1; walking and shuffling above 0.2",
    )
    swing_energy_mps2: float = parameter(
        0.8,
        "root mean square of the acceleration beside gravity over a stride below which the foot only swings",
        unit="m/s^2",
        bounds=(0.0, 20.0),
        source="measured: shuffles of 0.2 m 0.95 and more",
    )
    running_energy_mps2: float = parameter(
        3.5,
        "the same for a foot that hardly rests: below it no run is so slow",
        unit="m/s^2",
        bounds=(0.0, 50.0),
        source="measured on real runs: 95 % above 4.2, the slowest with strides of 0.6 m",
    )
    step_model: str = parameter(
        "zhou",
        "the model of a stride's length",
        choices=("zhou", "constant", "frequency_linear", "weinberg", "kim"),
        source="Zhou eq. 15",
    )
    group_hz: float = parameter(
        0.2,
        "strides whose frequencies differ by more are calibrated apart",
        unit="Hz",
        bounds=(0.01, 5.0),
        source="Zhou section 5",
    )
    model_sd_m: float = parameter(
        0.12,
        "how far off a model is in a single stride, until the strides tell",
        unit="m",
        bounds=(1e-3, 1.0),
        source="measured on real walks",
    )
    ready_strides: int = parameter(
        10, "a model is not used before it has learned from so many strides", bounds=(2, 1000)
    )
    ready_share: float = parameter(
        0.15,
        "nor where single strides differ from it by more than this share of their length",
        bounds=(0.01, 1.0),
        source="measured on real walks: 0.04 to 0.13",
    )
