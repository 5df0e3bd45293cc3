"""Qiu's Tables 3, 4 and 5 and his stairs: every method on every walk, and what each error of the sensor costs."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pdr_core.bench.qiu_walks import METHODS, SENSOR, Measured, QiuResult, Trial, measured, trials
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.response import Response

WHOLE = "nothing"
COSTED = ("3", "4")  # tables


@dataclass(frozen=True)
class Means:
    """Mean figures over the walks of a table by one method; errors without their signs."""

    walks: int
    distance_error_percent: float
    end_error_percent: float
    heading_error_deg: float
    error_per_turn_deg: float
    height_error_percent: float


@dataclass(frozen=True)
class Cost:
    """What the errors of the suite's own chain are without one error of the sensor."""

    table: str
    without: str
    means: Means


def qiu_tables(seen: Callable[[str], object] = str) -> list[Measured]:
    """Walk every walk by every method; `seen` is told which."""
    return [one for trial in trials() for one in by_every_method(trial, seen)]


def by_every_method(trial: Trial, seen: Callable[[str], object]) -> Iterator[Measured]:
    """Yield one walk by every method."""
    for method in METHODS:
        seen(f"Table {trial.table}, {trial.name}, {method}")
        yield measured(trial, method)


def costs(seen: Callable[[str], object] = str) -> list[Cost]:
    """Return the means of Tables 3 and 4 with each error of the sensor switched off in turn, and with all of them."""
    rows = []
    for table in COSTED:
        walks = [trial for trial in trials() if trial.table == table]
        for part, sensor in sensors().items():
            seen(f"Table {table} without {part}")
            rows.append(Cost(table, part, means([measured(walk, sensor=sensor).result for walk in walks])))
    return rows


def sensors() -> dict[str, SensorModel]:
    """Return the sensor, and what it would be without each of its errors."""
    s, magnetometer = SENSOR, SENSOR.magnetometer
    return {
        WHOLE: s,
        "gyro bias": replace(s, gyro_bias_sd_radps=0.0),
        "accelerometer bias": replace(s, accel_bias_sd_mps2=0.0),
        "noise": replace(
            s, gyro_noise_density=0.0, accel_noise_density=0.0, magnetometer=replace(magnetometer, noise_tesla=0.0)
        ),
        "alignment": with_response(s, alignment_sd_rad=0.0),
        "linearity": with_response(s, linearity=0.0),
        "bandwidth": with_response(s, bandwidth_hz=np.inf),
        "all of these": SensorModel(gyro_range_radps=s.gyro_range_radps, accel_range_mps2=s.accel_range_mps2),
    }


def with_response(s: SensorModel, **values: float) -> SensorModel:
    """Return the sensor with axes changed."""

    def new(response: Response) -> Response:
        return replace(response, **values)

    magnetometer = replace(s.magnetometer, response=new(s.magnetometer.response))
    return replace(
        s, gyro_response=new(s.gyro_response), accel_response=new(s.accel_response), magnetometer=magnetometer
    )


def of(results: Sequence[QiuResult], table: str, method: str) -> list[QiuResult]:
    """Return the walks of a table by one method."""
    return [r for r in results if (r.table, r.method) == (table, method)]


def means(results: Sequence[QiuResult]) -> Means:
    """Return the mean figures of walks."""
    names = [name for name in Means.__dataclass_fields__ if name != "walks"]
    return Means(len(results), **{n: float(np.mean([abs(getattr(r, n)) for r in results])) for n in names})
