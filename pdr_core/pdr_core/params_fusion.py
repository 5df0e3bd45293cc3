"""The parameters of what merges two feet."""

from dataclasses import dataclass

from pdr_core.parameter import parameter


@dataclass(frozen=True)
class FusionParams:
    """Two feet: their frames, the body between them."""

    straight_sd_rad: float = parameter(
        0.07,
        "on a straight line the headings of six strides of a foot spread by at most this",
        unit="rad",
        bounds=(0.0, 3.15),
        source="paper 004 eq. 7",
    )
    straight_turn_rad: float = parameter(
        0.1,
        "and the latest is turned by at most this from the mean of those before",
        unit="rad",
        bounds=(0.0, 3.15),
        source="paper 004 eq. 7",
    )
    stride_min_m: float = parameter(0.4, "a shorter stride has no direction", unit="m", bounds=(0.05, 3.0))
    heading_noise_rad: float = parameter(
        0.002, "what a stride adds to the heading error", unit="rad", bounds=(0.0, 1.0), source="paper 004 eq. 11"
    )
    heading_sd_min_rad: float = parameter(
        0.01, "a heading is never compared with the walking direction better than this", unit="rad", bounds=(1e-4, 1.0)
    )
    frame_strides: int = parameter(
        10,
        "so many straight strides of a foot show how its world is turned; what turns it since is drift, and fed back",
        bounds=(1, 1000),
    )
    drift_sd_radps: float = parameter(
        0.001,
        "how fast the track of a foot may turn",
        unit="rad/s",
        bounds=(0.0, 1.0),
        source="paper 004 eq. 4",
    )
    separation_max_m: float = parameter(
        1.5,
        "feet are never farther apart across the floor",
        unit="m",
        bounds=(0.1, 100.0),
        source="more than a sprinter's feet; paper 004 refs 8, 9",
    )
    separation_height_max_m: float = parameter(1.0, "nor one so much higher", unit="m", bounds=(0.1, 100.0))
    separation_sd_m: float = parameter(
        0.3,
        "how well these are known",
        unit="m",
        bounds=(0.001, 10.0),
        source="simulated feet after a gap: .2 to 1 alike",
    )
    mounting_apart_rad: float = parameter(
        0.8,
        "feet that walk in directions so different have no calibrated mounting",
        unit="rad",
        bounds=(0.0, 3.15),
    )
    stance_width_m: float = parameter(
        0.2, "distance between the feet of a person who stands", unit="m", bounds=(0.0, 1.0)
    )
    apart_sd_m: float = parameter(
        0.5,
        "by how much the feet of a walking person are elsewhere than side by side",
        unit="m",
        bounds=(0.01, 2.0),
        source="a stride of 1.4 m: from 0.7 m ahead to 0.7 m behind",
    )
    clock_apart_s: float = parameter(
        3600.0,
        "clocks of two feet that differ by more count from different moments: they are aligned by their first stamps",
        unit="s",
        bounds=(1.0, 1e12),
    )
