"""The parameters of the orientation filter and of the track without a filter."""

from dataclasses import dataclass

from pdr_core.parameter import parameter


@dataclass(frozen=True)
class AttitudeParams:
    """The quaternion filter: orientation alone. Start, gyro bias and gate are those of the group `filter`."""

    accel_sd_mps2: float = parameter(
        0.2,
        "what the accelerometer of a standing foot shows beside gravity at best",
        unit="m/s^2",
        bounds=(1e-3, 10.0),
        source="measured on real walks",
    )
    accel_correlation_s: float = parameter(
        0.1, "for so long that goes on: more samples in this time tell no more", unit="s", bounds=(0.0, 10.0)
    )
    motion_share: float = parameter(
        1.0,
        "without a verdict: share of the difference between specific force and gravity that may hide in its direction",
        bounds=(0.0, 100.0),
        source="measured on real walks",
    )
    motion_per_rate: float = parameter(
        2.0,
        "without a verdict: acceleration that may go with each rad/s of angular rate",
        unit="m/s^2 per rad/s",
        bounds=(0.0, 100.0),
        source="measured on real walks",
    )
    motion_memory_s: float = parameter(
        0.1, "without a verdict: a motion is forgotten by 1/e in this time", unit="s", bounds=(0.0, 10.0)
    )
    use_field: bool = parameter(
        False, "hold the heading by the magnetic field of the first rest: outdoors, or where the field is clean"
    )
    field_sd_rad: float = parameter(
        0.1, "how far off the direction of the field may be", unit="rad", bounds=(1e-3, 3.15), source="6 deg"
    )
    field_correlation_s: float = parameter(
        0.5, "for so long that goes on", unit="s", bounds=(0.0, 100.0), source="a stance: the foot stays in one place"
    )
    field_norm_share: float = parameter(
        0.1, "a field that is stronger or weaker by more than this share is disturbed", bounds=(0.0, 10.0)
    )
    field_dip_rad: float = parameter(
        0.09,
        "a field whose dip is off by more is disturbed",
        unit="rad",
        bounds=(0.0, 3.15),
        source="5 deg",
    )


@dataclass(frozen=True)
class DedriftParams:
    """The track without a filter: the drift of each swing is taken off."""

    drift: str = parameter(
        "noise",
        "how the drift has grown within a swing: with the noise of the samples, or steadily as the paper has it",
        choices=("noise", "steady"),
        source="Qiu eq. 24-26; measured on real walks: most of it comes with the shock of the heel",
    )
    stance_sd_mps: float = parameter(
        0.07,
        "a foot stands only where the detector says that it is so still",
        unit="m/s",
        bounds=(1e-3, 10.0),
        source="measured on real walks",
    )
