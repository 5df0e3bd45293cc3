"""Notices by the samples alone that the driver is not what it was, or does not do what it has said.

A driver that is killed and started again has its gyro on, and perhaps another clock; it tells nobody.
"""

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.params import PowerParams
from pdr_core.records_power import DriverAnswer, ModeCommand, Outcome, Sensed

OBEYED_NS = nanoseconds(1.0)  # so long after it said so, at the latest, the gyro of a driver is off
STARTED_AGAIN = "its stamps have jumped back: it was started again"
ON_AGAIN = "it gives rates although it has switched the gyro off: it was started again"
STILL_OFF = "it gives no rates although it has switched the gyro on"
SLEEPS_ON = "its gyro sleeps on although the foot walks"


class DriverWatch:
    """Compares what the driver has said with what comes."""

    def __init__(self, params: PowerParams) -> None:
        self._params = params
        self._said: bool | None = None  # about the gyro; None: nothing
        self._since_ns = NO_STAMP  # from then on the samples must be as it has said
        self._newest_ns = NO_STAMP
        self._by_itself = False  # the sensor switches the gyro
        self._well_ns = NO_STAMP  # the last rates, or the last samples of a foot that need not have any

    def answered(self, command: ModeCommand, answer: DriverAnswer) -> None:
        """Note what the driver says to a command."""
        acknowledged = answer.outcome is Outcome.ACKNOWLEDGED
        self._by_itself = acknowledged and command.on_motion
        self._said = command.gyro if acknowledged and not command.on_motion else None
        self._well_ns = max(self._well_ns, answer.effective_ns)
        patience_ns = nanoseconds(self._params.retry_s) if command.gyro else OBEYED_NS
        self._since_ns = max(answer.effective_ns, self._newest_ns) + patience_ns

    def run(self, stamp_ns: int, sensed: Sensed, walks: bool) -> str:
        """Return what is wrong by the newest samples, once; an empty text: nothing. `walks`: the foot does."""
        back, self._newest_ns = stamp_ns < self._newest_ns, stamp_ns
        self._well_ns = stamp_ns if back or sensed.gyro or not walks else self._well_ns
        fault = STARTED_AGAIN if back else self._contradiction(stamp_ns, sensed.gyro) or self._sleep(stamp_ns)
        if fault:
            self._said, self._by_itself = None, False
        return fault

    def _contradiction(self, stamp_ns: int, measured: bool) -> str:
        if self._said is None or self._said is measured or stamp_ns < self._since_ns:
            return ""
        return ON_AGAIN if measured else STILL_OFF

    def _sleep(self, stamp_ns: int) -> str:
        """Return whether a gyro sleeps on that was to wake in every swing."""
        return SLEEPS_ON if self._by_itself and stamp_ns - self._well_ns >= nanoseconds(self._params.retry_s) else ""
