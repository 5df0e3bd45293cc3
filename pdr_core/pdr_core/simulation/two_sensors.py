"""The sensors on both feet: mirrored or alike, and each with a part of its own.

In the mirror of the body y is reversed. A force (a polar vector) keeps x and z, a rate (an axial vector) keeps y alone,
and what a rate shows of the force along the same axis changes its sign for each.
So mirrored sensors turn the tracks of both feet by the same angle to opposite sides, the symmetric error of paper 004,
eq. 4; sensors that are alike turn both to the same side.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pdr_core.params import SimulationParams
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.two_feet import SIDES

OWN, SEEDS = 11, 12  # these streams of a seed
RATE, FORCE = np.array([-1.0, 1.0, -1.0]), np.array([1.0, -1.0, 1.0])


def both_sensors(sensor: SensorModel, params: SimulationParams) -> Mapping[str, SensorModel]:
    """Return the sensor of each foot, by name."""
    rng = np.random.default_rng([params.seed, OWN])
    return {name: one_sensor(sensor, side, params, rng) for name, side in SIDES.items()}


def one_sensor(sensor: SensorModel, side: float, params: SimulationParams, rng: np.random.Generator) -> SensorModel:
    """Return the sensor of the foot of this side; the left one has the signs of the model."""
    mirrored = side < 0.0 and params.feet_errors == "mirrored"
    rate, force = (RATE, FORCE) if mirrored else (np.ones(3), np.ones(3))
    own = 1.0 + params.feet_independent * rng.standard_normal((3, 3))
    return replace(
        sensor,
        gyro_bias_radps=tuple(rate * own[0] * sensor.gyro_bias_radps),
        accel_bias_mps2=tuple(force * own[1] * sensor.accel_bias_mps2),
        gyro_g_sensitivity=tuple(rate * force * own[2] * sensor.gyro_g_sensitivity),
    )


def seeds(params: SimulationParams) -> Mapping[str, int]:
    """Return the seed of each foot's noise and shocks."""
    drawn = np.random.default_rng([params.seed, SEEDS]).integers(2**31, size=len(SIDES))
    return {name: int(seed) for name, seed in zip(SIDES, drawn, strict=True)}
