"""The parameters of the heading constraint of one foot."""

from dataclasses import dataclass

from pdr_core.parameter import parameter

CONSTRAINTS = ("none", "dominant", "hde", "ihde", "learned")


@dataclass(frozen=True)
class HeadingParams:
    """The heading constraint: which directions the straight lines of a walk have."""

    constraint: str = parameter(
        "none",
        "what holds the heading on straight lines: their own direction, those of a building, or those walked before",
        choices=CONSTRAINTS,
        source="Gui section 4.1",
    )
    walking_direction: str = parameter(
        "stride",
        "the direction of a step: where its displacement points, or where the foot points that stands after it",
        choices=("stride", "foot"),
        source="foot: Gui section 4.1",
    )
    straight_strides: int = parameter(
        4,
        "so many strides show whether the walk goes straight",
        bounds=(2, 20),
        source="Gui eq. 10 has 3; measured on real walks",
    )
    straight_max_rad: float = parameter(
        0.087,
        "a stride that is turned by more from their mean is part of a curve",
        unit="rad",
        bounds=(0.0, 3.15),
        source="5 deg; Gui eq. 10 has no figure; measured on real walks",
    )
    stride_min_m: float = parameter(
        0.4, "a shorter stride has no heading", unit="m", bounds=(0.0, 10.0), source="feet sway by some centimetres"
    )
    stride_sd_rad: float = parameter(
        0.035,
        "how much headings of strides differ on a straight line, as long as few have shown it",
        unit="rad",
        bounds=(1e-4, 1.0),
        source="2 deg: measured on real walks, 1.8 to 2.8",
    )
    direction_spreads: float = parameter(
        3.0,
        "how far straight lines are off their direction, in deviations of the headings of strides",
        bounds=(0.0, 100.0),
        source="measured on real walks",
    )
    wander_spreads: float = parameter(
        0.4,
        "by how much a straight line bends from one stride to the next, in deviations of the headings of strides",
        bounds=(0.0, 100.0),
        source="measured on real walks",
    )
    gate: float = parameter(
        4.0,
        "normalised innovation squared beyond which a stride is not of the line, or the line not of the direction",
        bounds=(0.1, 1e9),
        source="2 deviations",
    )
    learn_gate: float = parameter(
        9.0,
        "learned: normalised distance squared from all known directions beyond which a line shows a new one",
        bounds=(0.1, 1e9),
        source="3 deviations",
    )
    learn_yaw_sd_max_rad: float = parameter(
        0.052,
        "learned: no new direction with a yaw known worse than this",
        unit="rad",
        bounds=(0.0, 3.15),
        source="3 deg",
    )
    building_directions: int = parameter(
        4, "hde, ihde: directions of the building: 4, 8 or 12", bounds=(2, 12), source="Gui section 4.1"
    )
    building_from: str = parameter(
        "first_line",
        "hde, ihde: one of the directions is that of the first straight line, or building_heading_rad",
        choices=("first_line", "given"),
    )
    building_heading_rad: float = parameter(
        0.0,
        "hde, ihde: one of the directions, counter-clockwise from x of the world",
        unit="rad",
        bounds=(-3.15, 3.15),
    )
