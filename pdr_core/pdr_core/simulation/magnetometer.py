"""What a magnetometer on the foot measures: iron about it, its axes, noise, range, and a rate of its own."""

from dataclasses import dataclass, field

import numpy as np

from pdr_core.records import Flags, Floats, ImuBlock
from pdr_core.simulation.response import Response, answer

IRON, FIELD_AXES, FIELD_NOISE = 6, 7, 8  # these streams of a seed
Axes = tuple[float, float, float]
NO_SOFT_IRON = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Magnetometer:
    """Iron that moves with the sensor, noise, range and axes: measured = soft iron field + hard iron + noise."""

    hard_iron_tesla: Axes = (0.0, 0.0, 0.0)
    hard_iron_sd_tesla: float = 0.0  # of what each seed adds to each axis
    soft_iron: tuple[Axes, Axes, Axes] = NO_SOFT_IRON
    soft_iron_sd: float = 0.0  # of what each seed adds to each element; soft iron is symmetric
    noise_tesla: float = 0.0  # of one sample of one axis
    range_tesla: float = np.inf
    response: Response = field(default_factory=Response)

    def iron(self, seed: int) -> tuple[Floats, Floats]:
        """Return soft iron (3, 3) and hard iron (3,) [T] of the sensor with this seed."""
        drawn = np.random.default_rng([seed, IRON]).standard_normal((4, 3))
        lower = np.tril(drawn[:3])
        symmetric = lower + np.tril(lower, -1).T
        soft = np.array(self.soft_iron) + self.soft_iron_sd * symmetric
        return soft, np.array(self.hard_iron_tesla) + self.hard_iron_sd_tesla * drawn[3]


def about_the_sensor(field_tesla: Floats, rate_hz: float, sensor: Magnetometer, seed: int) -> Floats:
    """Return what the axes show of the true field along them, (n, 3) both [T], that follows at `rate_hz`."""
    soft, hard = sensor.iron(seed)
    rng = np.random.default_rng([seed, FIELD_AXES])
    return answer(field_tesla @ soft.T + hard, rate_hz, sensor.response, sensor.range_tesla, rng)


def with_field(imu: ImuBlock, shown_tesla: Floats, sensor: Magnetometer, measured: Flags, seed: int) -> ImuBlock:
    """Return the samples with what the axes show, (n, 3) [T], after noise and range, where it is measured, (n,)."""
    noise = np.random.default_rng([seed, FIELD_NOISE]).standard_normal(shown_tesla.shape)
    field_tesla = np.clip(shown_tesla + sensor.noise_tesla * noise, -sensor.range_tesla, sensor.range_tesla)
    sd_tesla = np.where(measured, sensor.noise_tesla, -1.0)
    return imu._replace(field_tesla=np.where(measured[:, None], field_tesla, 0.0), field_sd_tesla=sd_tesla)


def at_rate(time_s: Floats, rate_hz: float) -> Flags:
    """Return which samples at ascending times, (n,) [s], are the first of a new turn of a slower clock; 0: all."""
    if rate_hz == 0.0:
        return np.ones(len(time_s), dtype=bool)
    turns = np.floor(time_s * rate_hz + 1e-6)
    return np.diff(turns, prepend=-1.0) > 0.0
