"""The family of stance detectors and of time gates by name."""

from collections.abc import Callable
from typing import NamedTuple

from pdr_core.conventions import nanoseconds
from pdr_core.params import DetectorParams, StanceParams
from pdr_core.records import Floats, ImuBlock
from pdr_core.stance import (
    acceleration_magnitude,
    acceleration_moving_variance,
    angular_rate_energy,
    glrt,
    mbgtd,
    three_conditions,
)
from pdr_core.stance.gait_phases import GaitPhases
from pdr_core.stance.kmeans_gate import KmeansGate
from pdr_core.stance.time_gate import TimeGate


class Detector(NamedTuple):
    """How much a foot moves, and the threshold up to which it stands."""

    statistics: Callable[..., Floats]  # (imu, start, stop, half_window_ns, *numbers) -> (stop - start,)
    window_s: float
    numbers: tuple[float, ...]
    threshold: float | None  # of the statistic; None: relative to the last swing

    def judge(self, imu: ImuBlock, start: int, stop: int) -> Floats:
        """Return the statistic of the samples start:stop."""
        return self.statistics(imu, start, stop, self.half_window_ns, *self.numbers)

    @property
    def half_window_ns(self) -> int:
        """How far the window reaches to either side of a sample [ns]."""
        return nanoseconds(self.window_s / 2.0)


def detectors(stance: StanceParams, own: DetectorParams, gravity_mps2: float) -> dict[str, Detector]:
    """Return every detector under the name by which `stance.detector` picks it."""
    likelihood = (gravity_mps2, stance.accel_sd_mps2, stance.gyro_sd_radps)
    conditions = (
        own.three_conditions_force_threshold,
        own.three_conditions_variance_threshold,
        own.three_conditions_rate_threshold,
    )
    return {
        "adaptive": Detector(glrt.statistics, stance.window_s, likelihood, None),
        "glrt": Detector(glrt.statistics, own.glrt_window_s, likelihood, own.glrt_threshold),
        "angular_rate_energy": Detector(
            angular_rate_energy.statistics, own.angular_rate_energy_window_s, (), own.angular_rate_energy_threshold
        ),
        "acceleration_moving_variance": Detector(
            acceleration_moving_variance.statistics,
            own.acceleration_moving_variance_window_s,
            (),
            own.acceleration_moving_variance_threshold,
        ),
        "acceleration_magnitude": Detector(
            acceleration_magnitude.statistics,
            own.acceleration_magnitude_window_s,
            (gravity_mps2,),
            own.acceleration_magnitude_threshold,
        ),
        "mbgtd": Detector(mbgtd.statistics, own.mbgtd_window_s, (), own.mbgtd_threshold),
        "three_conditions": Detector(
            three_conditions.statistics, own.three_conditions_window_s, (gravity_mps2, *conditions), 1.0
        ),
    }


def time_gates(own: DetectorParams, phases_s: Floats | None) -> dict[str, TimeGate | None]:
    """Return every time gate, fresh, under the name by which `stance.time_gate` picks it; None lets all pass."""
    return {"none": None, "gait_phases": GaitPhases(own), "kmeans": KmeansGate(own, phases_s)}
