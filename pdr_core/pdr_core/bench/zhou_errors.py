"""How far a scheme is off on the second lap: the figures of Zhou's Table 5, and the true ones beside them.

Eq. 23 is called a root mean square but adds up plain distances: it is their mean over the eight corners and the end.
Here both are given; the root mean square is that over all strides, whose true places a simulation knows. A tester ends
a lap near where it began, but not just there: the misclosure is what the end is off the true one.
"""

from dataclasses import asdict, dataclass

import numpy as np

from pdr_core.bench.zhou_schemes import Track
from pdr_core.bench.zhou_walks import Octagon
from pdr_core.maths.circular import wrapped_rad


@dataclass(frozen=True)
class LapResult:
    """One second lap by one scheme at one rate."""

    gait: str
    tester: str
    seed: int
    scheme: str
    rate_hz: int
    corner_error_m: float  # Zhou eq. 23
    rmse_m: float  # over all strides
    misclosure_m: float
    heading_error_deg: float  # largest, of the walking direction
    distance_error_percent: float  # Zhou eq. 22
    distance_error_m: float
    strides: int
    strides_true: int


def result(octagon: Octagon, scheme: str, rate_hz: int, track: Track) -> LapResult:
    """Return the figures of a lap; it begins where it does in truth."""
    true_m, half = octagon.stand_m[octagon.half :], octagon.half
    off_m = np.linalg.norm((track.position_m - track.position_m[0]) - (true_m - true_m[0]), axis=1)
    true_lap_m = float(np.linalg.norm(np.diff(true_m, axis=0), axis=1).sum())
    points = [*(i - half for i in octagon.corners), len(true_m) - 1]
    return LapResult(
        **asdict(octagon.trial),
        scheme=scheme,
        rate_hz=rate_hz,
        corner_error_m=float(off_m[points].mean()),
        rmse_m=float(np.sqrt(np.mean(off_m**2))),
        misclosure_m=float(off_m[-1]),
        heading_error_deg=heading_error_deg(octagon, track),
        distance_error_percent=100.0 * abs(track.distance_m / true_lap_m - 1.0),
        distance_error_m=abs(track.distance_m - true_lap_m),
        strides=track.strides,
        strides_true=len(true_m) - 1,
    )


def heading_error_deg(octagon: Octagon, track: Track) -> float:
    """Return the largest error of the direction in which the person is taken to walk."""
    missed_rad = track.deviation_rad - octagon.deviation_rad
    true_rad = octagon.stand_yaw_rad[octagon.half :]
    errors = [wrapped_rad(float(a - b) + missed_rad) for a, b in zip(track.yaw_rad, true_rad, strict=True)]
    return float(np.degrees(np.abs(errors).max()))
