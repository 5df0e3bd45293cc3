"""A walk of the stress test: what a seed draws from the ranges, and what the sensor gave on it."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.bench.stress_ranges import RANGES, Stretch, Trouble
from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.records import Floats
from pdr_core.simulation import SimulatedWalk
from pdr_core.simulation.foot_motion import FootCourse
from pdr_core.simulation.gait import Stride
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.walk import walked

STRESS = 3  # this stream of a seed
NO_TROUBLE = Trouble("none", (0.0, 0.0), "", hides_motion=False)


@dataclass(frozen=True)
class Drawn:
    """What one seed has drawn."""

    seed: int
    stretches: tuple[tuple[str, float, int], ...]  # name, pace, strides
    strides: tuple[Stride, ...]
    rate_hz: float
    sensor: SensorModel
    shock_mps2: float
    mounting: Rotation  # foot from sensor
    trouble: Trouble
    amount: float  # of the trouble, in its own unit
    at: float  # share of the distance at which it begins
    trouble_seed: int

    @property
    def text(self) -> str:
        """Everything in one line."""
        strides = ", ".join(f"{n} {name} at {pace:.2f}" for name, pace, n in self.stretches)
        gyro_dps, accel_g = (
            np.degrees(self.sensor.gyro_range_radps),
            self.sensor.accel_range_mps2 / STANDARD_GRAVITY_MPS2,
        )
        sensor = f"{self.rate_hz:.0f} Hz, {gyro_dps:.0f} deg/s, {accel_g:.0f} g, shocks {self.shock_mps2:.0f} m/s^2"
        trouble = f"{self.trouble.name} {self.amount:.2g} {self.trouble.unit} at {self.at:.0%}"
        return f"{sensor}; {trouble if self.trouble != NO_TROUBLE else 'no trouble'}; {strides}"

    @property
    def told(self) -> Params:
        """The default parameters, and from the data sheet the ranges."""
        gyro, accel = self.sensor.gyro_range_radps, self.sensor.accel_range_mps2
        return changed(Params(), "intake", gyro_range_radps=gyro, accel_range_mps2=accel)


def drawn(seed: int) -> Drawn:
    """Draw a walk."""
    r, rng = RANGES, np.random.default_rng([seed, STRESS])
    stretches, strides = drawn_strides(rng)
    troubled = rng.random() < r.troubled
    trouble = r.troubles[rng.integers(len(r.troubles))] if troubled else NO_TROUBLE
    return Drawn(
        seed,
        tuple(stretches),
        tuple(strides),
        float(np.exp(rng.uniform(*np.log(r.rate_hz)))),
        drawn_sensor(rng),
        rng.uniform(*r.shock_mps2),
        Rotation.random(random_state=rng),
        trouble,
        rng.uniform(*trouble.amount),
        rng.uniform(*r.trouble_at),
        int(rng.integers(2**31)),
    )


def drawn_strides(rng: np.random.Generator) -> tuple[list[tuple[str, float, int]], list[Stride]]:
    """Return stretches until the distance is walked, and their strides."""
    distance_m, path_m = rng.uniform(*RANGES.distance_m), 0.0
    stretches: list[tuple[str, float, int]] = []
    strides: list[Stride] = []
    while path_m < distance_m:
        stretch = RANGES.stretches[rng.integers(len(RANGES.stretches))]
        pace, count = rng.uniform(*stretch.pace), int(rng.integers(stretch.strides[0], stretch.strides[1] + 1))
        some = strides_of(stretch, pace, count, rng)
        stretches.append((stretch.name, pace, count))
        strides += some
        path_m += sum(s.gait.length_m for s in some)
    return stretches, strides


def strides_of(stretch: Stretch, pace: float, count: int, rng: np.random.Generator) -> list[Stride]:
    """Return the strides of one stretch."""
    turn_rad = rng.uniform(*stretch.turn_rad) / count
    gaits = [stretch.gait.paced(pace * rng.uniform(*RANGES.uneven)) for _ in range(count)]
    strides = [Stride(gait, turn_rad, stretch.climb_m) for gait in gaits]
    return [*strides[:-1], replace(strides[-1], pause_s=rng.uniform(*stretch.pause_s))]


def drawn_sensor(rng: np.random.Generator) -> SensorModel:
    """Return a sensor with biases, noise and ranges of its own."""
    r = RANGES
    return SensorModel(
        gyro_noise_density=rng.uniform(*r.gyro_noise_density),
        accel_noise_density=rng.uniform(*r.accel_noise_density),
        gyro_bias_sd_radps=r.gyro_bias_sd_radps,
        accel_bias_sd_mps2=r.accel_bias_sd_mps2,
        gyro_range_radps=float(np.radians(rng.choice(r.gyro_range_dps))),
        accel_range_mps2=float(rng.choice(r.accel_range_g)) * STANDARD_GRAVITY_MPS2,
    )


def sensed_walk(d: Drawn, turned: Rotation | None = None) -> SimulatedWalk:
    """Return what the sensor gives without the trouble, or when it has turned on the foot."""
    mounting = d.mounting if turned is None else d.mounting * turned
    roll, pitch, yaw = (float(angle) for angle in mounting.as_euler("xyz"))
    params = SimulationParams(
        motion="smooth",
        sample_rate_hz=d.rate_hz,
        earth_rate=True,
        mounting_roll_rad=roll,
        mounting_pitch_rad=pitch,
        mounting_yaw_rad=yaw,
        shock_mps2=d.shock_mps2,
        seed=d.seed,
    )
    return walked(FootCourse(list(d.strides)), params, model=d.sensor)


def walked_m(position_m: Floats) -> Floats:
    """Return the horizontal path [m] up to each of n positions (n, 3), (n,)."""
    return np.cumsum(np.linalg.norm(np.diff(position_m[:, :2], axis=0, prepend=position_m[:1, :2]), axis=1))
