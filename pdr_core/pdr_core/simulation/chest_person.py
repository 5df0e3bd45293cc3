"""The person who wears the chest card: how people walk and stand, with where each figure comes from.

Every seed draws another person from these figures, and that person's phases.

- speed 1.0 to 1.5 m/s: Cheng section 4
- step length by cadence, 0.0064 m per step/min: walk ratio, Sekiya and Nagasaki 1998 (*)
- speed varies slowly by 2.3 %, and a step beside it by 1.5 % of its length: Collins and Kuo 2013 (PLoS ONE 8:e73597)
- peak to peak from 0.7 to 1.6 m/s, sideways 6.99 to 3.85 cm, up and down 2.74 to 4.83 cm: Orendurff et al. 2004
  (J. Rehabil. Res. Dev. 41:829) (*)
- largest forward acceleration in a step 2.9 m/s^2: Cheng section 3.2.4
- trunk against the room: lean -0.2 +- 3.6 deg; peak to peak pitch 4.0 +- 1.8, roll 3.3 +- 1.4, yaw 6.9 +- 2.9 deg:
  Chung et al. 2010 (J. Neuroeng. Rehabil. 7:9)
- standing people show 0.0368 m/s^2 (RMS) of the trunk: Neville et al. 2015 (Med. Devices 8:447), two legs, eyes open
- gait begins and ends within two steps: Miff et al. 2005 (Gait Posture 22:33) (*)
- a sensor on the breastbone is 0.12 m before the axis of a turn, half a chest's depth, and 1.25 m above the ankles:
  NASA-STD-3000 (*)

(*) The paper itself was not at hand: the figure is as it is quoted elsewhere.

What no source tells is said where it stands: how far the trunk leans into a start (half of what would balance it), how
fast sway is (0.1 to 1 Hz), how much of the gait's oscillation is left in a turn on the spot (half).
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.records import Floats

WALK_RATIO = 0.0064 * 60.0  # [m s] step length by cadence in steps a second
SPEED_MPS = (1.0, 1.5)
SPEED_SHARE, STEP_SHARE = 0.023, 0.015
SPEED_STEPS = 5.0  # over so many steps the slow variation of the speed is lost: "slow" in Collins and Kuo
SWAY_SPEEDS_MPS, SWAY_M, BOUNCE_M = (0.7, 1.6), (0.0699, 0.0385), (0.0274, 0.0483)
SURGE_MPS2 = 2.916
LEAN_SD_DEG, RANGES_DEG, RANGE_SDS_DEG = 3.6, (3.3, 4.0, 6.9), (1.4, 1.8, 2.9)  # roll, pitch, yaw
SMALLEST_RANGE = 0.2  # of the mean: a normal distribution has tails that people have not
STANDING_MPS2 = 0.0368
STANDING_HZ = (0.1, 1.0)
STANDING_WAVES = 6
AHEAD_M, HEIGHT_M = 0.12, 1.25
LEAN_SHARE = 0.5
PERSON = 20  # this stream of a seed


class Person(NamedTuple):
    """One person; angles are amplitudes, half of what is called a range."""

    speed_mps: float
    step_m: float
    sway_m: float
    bounce_m: float
    surge_m: float
    lean_rad: float
    swing_rad: Floats  # (3,) roll, pitch, yaw
    phase_rad: Floats  # (3,) of these in the stride, and for pitch in the step
    standing_rad: Floats  # (2, waves) roll and pitch of the swaying body
    standing_hz: Floats  # (waves,)
    standing_phase_rad: Floats  # (2, waves)

    @property
    def step_s(self) -> float:
        """How long a step takes."""
        return self.step_m / self.speed_mps


def person(seed: int, speed_mps: float = 0.0) -> Person:
    """Return the person of a seed, who walks at a speed, or at one of their own for 0."""
    rng = np.random.default_rng([seed, PERSON])
    drawn_mps = rng.uniform(*SPEED_MPS)
    speed = speed_mps or drawn_mps
    step_m = float(np.sqrt(WALK_RATIO * speed))
    ranges = np.maximum(rng.normal(RANGES_DEG, RANGE_SDS_DEG), SMALLEST_RANGE * np.array(RANGES_DEG))
    hz = np.geomspace(*STANDING_HZ, STANDING_WAVES).astype(np.float64)
    return Person(
        speed_mps=speed,
        step_m=step_m,
        sway_m=0.5 * float(np.interp(speed, SWAY_SPEEDS_MPS, SWAY_M)),
        bounce_m=0.5 * float(np.interp(speed, SWAY_SPEEDS_MPS, BOUNCE_M)),
        surge_m=SURGE_MPS2 / (2.0 * np.pi * speed / step_m) ** 2,
        lean_rad=float(np.radians(rng.normal(0.0, LEAN_SD_DEG))),
        swing_rad=0.5 * np.radians(ranges),
        phase_rad=rng.uniform(0.0, 2.0 * np.pi, 3),
        standing_rad=standing_waves_rad(hz),
        standing_hz=hz,
        standing_phase_rad=rng.uniform(0.0, 2.0 * np.pi, (2, STANDING_WAVES)),
    )


def standing_waves_rad(hz: Floats) -> Floats:
    """Return the amplitudes of sway, (2, waves): larger the slower, and together as large as the source has measured.

    A trunk that sways by t about the ankles shows the force (g + h w^2) t along its x axis: it is felt as larger than
    it is.
    """
    shape = 1.0 / hz
    felt = (STANDARD_GRAVITY_MPS2 + HEIGHT_M * (2.0 * np.pi * hz) ** 2) * shape
    return np.tile(shape * STANDING_MPS2 / np.sqrt(0.5 * np.sum(felt**2)), (2, 1))
