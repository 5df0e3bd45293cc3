"""What the stress test may draw: how people walk, what sensors are, what goes wrong.

Written down before the first run, and not narrowed since.
"""

from dataclasses import dataclass

import numpy as np

from pdr_core.simulation.gait import RISE_M, RUN, SHUFFLE, STAIRS_DOWN, STAIRS_UP, WALK, Gait

Range = tuple[float, float]  # drawn uniformly between its ends


@dataclass(frozen=True)
class Stretch:
    """Some strides of one gait."""

    name: str
    gait: Gait
    pace: Range  # the usual speed is 1
    strides: tuple[int, int]
    turn_rad: Range = (0.0, 0.0)  # altogether
    climb_m: float = 0.0  # a stride
    pause_s: Range = (0.0, 0.0)  # at its end


@dataclass(frozen=True)
class Trouble:
    """Something that goes wrong. What hides the motion parts the track: each part is aligned by itself."""

    name: str
    amount: Range
    unit: str
    hides_motion: bool


@dataclass(frozen=True)
class Ranges:
    """Everything that a seed draws; where several values stand, each is as likely as the others."""

    distance_m: Range = (40.0, 120.0)
    stretches: tuple[Stretch, ...] = (
        Stretch("walk", WALK, (0.7, 1.3), (4, 20)),
        Stretch("run", RUN, (0.8, 1.2), (4, 12)),
        Stretch("sprint", RUN, (1.2, 1.6), (3, 8)),  # the foot accelerates by up to 11 g
        Stretch("shuffle", SHUFFLE, (0.7, 1.3), (3, 12)),
        Stretch("stairs up", STAIRS_UP, (0.8, 1.2), (4, 9), climb_m=RISE_M),
        Stretch("stairs down", STAIRS_DOWN, (0.8, 1.2), (4, 9), climb_m=-RISE_M),
        Stretch("curve", WALK, (0.7, 1.3), (4, 12), turn_rad=(-np.pi, np.pi)),
        Stretch("turn", SHUFFLE, (0.7, 1.3), (6, 12), turn_rad=(-np.pi, np.pi)),
        Stretch("stand", SHUFFLE, (0.7, 1.3), (1, 1), pause_s=(1.0, 5.0)),
    )
    uneven: Range = (0.95, 1.05)  # the pace of each stride beside that of its stretch
    rate_hz: Range = (100.0, 1000.0)  # uniform in its logarithm
    gyro_noise_density: Range = (8.7e-5, 2.6e-4)  # 0.005 .. 0.015 deg/s/sqrt(Hz)
    accel_noise_density: Range = (1.0e-3, 3.0e-3)  # 100 .. 300 ug/sqrt(Hz)
    gyro_bias_sd_radps: float = 0.0087  # 0.5 deg/s: of the normal turn-on bias of each axis
    accel_bias_sd_mps2: float = 0.1  # 10 mg
    gyro_range_dps: tuple[float, ...] = (500.0, 1000.0, 2000.0)
    accel_range_g: tuple[float, ...] = (8.0, 16.0)
    shock_mps2: Range = (0.0, 80.0)  # the strongest at heel strike
    # the mounting is any, all equally likely
    troubled: float = 0.6  # share of the seeds
    troubles: tuple[Trouble, ...] = (
        Trouble("gap", (0.2, 5.0), "s", hides_motion=True),
        Trouble("clipped", (1.0, 3.0), "s", hides_motion=True),
        Trouble("kicked", (0.3, 1.2), "rad", hides_motion=True),
        Trouble("fall", (1.0, 1.0), "s", hides_motion=True),
        Trouble("jitter", (0.05, 0.4), "intervals", hides_motion=False),  # each stamp is off by at most so much
        Trouble("lost", (0.005, 0.03), "of all samples", hides_motion=False),
    )
    trouble_at: Range = (0.35, 0.65)  # of the distance: what hides the motion begins there
    clipped_radps: Range = (0.8, 4.0)  # of clipped seconds
    clipped_mps2: Range = (10.5, 30.0)
    fall_radps: float = 6.0  # deviation of each axis
    fall_mps2: float = 30.0


RANGES = Ranges()
FAILED_PERCENT = 3.0  # ATE2 of the distance
STRIDES_BACK = 2  # of good stance, after which the track must be right again
