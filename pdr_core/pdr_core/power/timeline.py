"""How the sensor was powered over a walk, and what that has cost."""

from copy import copy
from dataclasses import dataclass, field

from pdr_core.power.energy import EnergyModel
from pdr_core.records_power import Energy, PowerState


@dataclass
class PowerTimeline:
    """What held from which stamp on, and how far the walk has come."""

    states: list[PowerState] = field(default_factory=list)
    last_ns: int = 0
    _counted: EnergyModel | None = field(default=None, init=False)
    _states: int = field(default=0, init=False)  # so many
    _how: tuple[str, bool, float] | None = field(default=None, init=False)

    def energy(self, part: str, magnetometer: bool, full_rate_hz: float) -> Energy:
        """Return the charge so far, against the same time with the gyro always on at the full rate.

        States that were counted are not counted again: a gyro that wakes in every swing has thousands an hour.
        """
        how = part, magnetometer, full_rate_hz
        if self._counted is None or self._how != how:
            self._counted, self._states, self._how = EnergyModel(*how), 0, how
        for state in self.states[self._states :]:
            self._counted.run(state)
        self._states = len(self.states)
        so_far = copy(self._counted)
        if self.states:
            so_far.pass_to(self.last_ns)
        return so_far.energy
