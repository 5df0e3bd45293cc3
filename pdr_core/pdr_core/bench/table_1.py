"""Gui Table 1: the ZUPT pipeline on Gui's own walk with the sensor of the table.

The table prints the gyro noise as 0.1 rad/sqrt(s); 0.1 deg/sqrt(s) may be meant. Both are run, each as delivered and
with a suite that has been told the sensor: its noise, and how large its biases may be.
"""

from dataclasses import dataclass

import numpy as np

from pdr_core.evaluation.metrics import ate2_m, end_error_percent, path_length_m
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import joined
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.sensors import SENSOR_MODELS

RATE_HZ = 100.0  # f, Table 1
LENGTH_M = 100.0
MODELS = ("ideal", "consumer", "gui_table_1_deg", "gui_table_1")


@dataclass(frozen=True)
class Table1Result:
    """One walk around the rectangle."""

    sensor_model: str
    told: bool  # the suite knows noise and biases of the sensor
    distance_m: float
    end_error_percent: float
    ate2_m: float
    strides: int
    true_strides: int
    notices: tuple[str, ...]  # what the suite says itself


def table_1_results(seed: int = 1) -> list[Table1Result]:
    """Return the results of all sensors, as delivered and told."""
    return [result(model, told, seed) for model in MODELS for told in (False, True)]


def result(model: str, told: bool, seed: int) -> Table1Result:
    """Return the result of one sensor."""
    simulation = SimulationParams(
        motion="gui", walk_length_m=LENGTH_M, sensor_model=model, sample_rate_hz=RATE_HZ, seed=seed
    )
    walk = simulated_walk(simulation)
    chain = FootInertial(told_of(model) if told else Params())
    outputs = [chain.run(walk.imu), chain.finish()]
    track_m = joined([output.nav for output in outputs]).position_m
    true_m = walk.motion.position_m
    return Table1Result(
        model,
        told,
        path_length_m(true_m),
        end_error_percent(track_m, true_m),
        ate2_m(track_m, true_m),
        sum(len(output.steps) for output in outputs),
        int(np.sum(np.diff(walk.motion.stance.astype(int)) == 1)),
        tuple(notice.kind for notice in chain.notices),
    )


def told_of(model: str) -> Params:
    """Return parameters that know the sensor: never less noise than the defaults, and biases of its size."""
    sensor, params = SENSOR_MODELS[model], Params()
    params = changed(
        params,
        "intake",
        gyro_noise_density=max(params.intake.gyro_noise_density, sensor.gyro_noise_density),
        accel_noise_density=max(params.intake.accel_noise_density, sensor.accel_noise_density),
    )
    gyro, accel = (float(np.abs(bias).max()) for bias in (sensor.gyro_bias_radps, sensor.accel_bias_mps2))
    return changed(
        params,
        "filter",
        initial_gyro_bias_sd_radps=max(params.filter.initial_gyro_bias_sd_radps, gyro),
        initial_accel_bias_sd_mps2=max(params.filter.initial_accel_bias_sd_mps2, accel),
    )
