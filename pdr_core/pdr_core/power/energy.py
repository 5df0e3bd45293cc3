"""Adds up what a sensor draws while its gyro goes on and off and its rate changes.

    charge = sum over the time of I(gyro, rate), at the sensor; with what sends the samples, at the node

A gyro that is switched on draws its full current before its rates can be trusted. This start-up charge, current times
start-up time of the part, is within the sum, because the timeline tells when the gyro is powered; it is given apart.
"""

from dataclasses import replace

from pdr_core.conventions import NANOSECONDS
from pdr_core.power.parts import NRF52832, PARTS, sample_bytes
from pdr_core.records_power import Charge, Energy, PowerState

SECONDS_PER_HOUR = 3600.0
NOTHING = Charge(0.0, 0.0)


class EnergyModel:
    """Integrates a timeline of gyro power and rate."""

    def __init__(self, part: str, magnetometer: bool, full_rate_hz: float) -> None:
        """`magnetometer`: it measures too; `full_rate_hz`: the rate of the sensor whose gyro is always on."""
        known = PARTS[part]
        self._part = known if magnetometer else known._replace(mag_ma=0.0)
        self._magnetometer = magnetometer
        self._always = PowerState(0, True, full_rate_hz)
        self._now: PowerState | None = None
        self._last_ns = 0
        self._sum = Energy(part, 0.0, 0.0, 0, 0.0, NOTHING, NOTHING)

    def run(self, state: PowerState) -> None:
        """Take what holds from a stamp on, as the driver says it."""
        self.pass_to(state.stamp_ns)
        if state.gyro_on and self._now and not self._now.gyro_on:
            start_up_mah = self._part.gyro_ma * self._part.start_s / SECONDS_PER_HOUR
            self._sum = replace(
                self._sum, switch_ons=self._sum.switch_ons + 1, start_up_mah=self._sum.start_up_mah + start_up_mah
            )
        self._now, self._last_ns = state, state.stamp_ns

    def pass_to(self, stamp_ns: int) -> None:
        """Let the time pass to a stamp; where the clock has jumped back, none has passed."""
        if self._now:
            time_s, s = max(0, stamp_ns - self._last_ns) / NANOSECONDS, self._sum
            self._sum = replace(
                s,
                duration_s=s.duration_s + time_s,
                gyro_on_s=s.gyro_on_s + time_s * self._now.gyro_on,
                drawn=added(s.drawn, self._current_ma(self._now), time_s),
                always_on=added(s.always_on, self._current_ma(self._always), time_s),
            )
        self._last_ns = stamp_ns

    @property
    def energy(self) -> Energy:
        """What was drawn so far."""
        return self._sum

    def _current_ma(self, state: PowerState) -> tuple[float, float]:
        """Return the current of sensor and node."""
        sensor_ma = self._part.sensor_ma(state.gyro_on, state.rate_hz)
        size = sample_bytes(state.gyro_on, self._magnetometer)
        return sensor_ma, sensor_ma + NRF52832.sending_ma(size, state.rate_hz)


def added(charge: Charge, current_ma: tuple[float, float], time_s: float) -> Charge:
    """Return the charge with that of a current of sensor and node over a time."""
    sensor_ma, node_ma = current_ma
    hours = time_s / SECONDS_PER_HOUR
    return Charge(charge.sensor_mah + sensor_ma * hours, charge.node_mah + node_ma * hours)
