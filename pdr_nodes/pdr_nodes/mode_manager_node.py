"""Node `mode_manager`: what is seen of a walk in (`walk`); what navigates, and why, out (`mode`).

It switches the gyro of the driver and changes its rate (`set_gyro_power`, `set_sample_rate`), and waits for no answer.
A driver that is absent, slow, refuses or is gone leaves the gyro wanted on, and is asked again.
"""

import time

from pdr_core.params import Params
from pdr_core.power import Supervision
from pdr_core.records import Level, Notice
from pdr_core.records_power import DriverAnswer, ModeCommand
from pdr_msgs.msg import NavigationMode, WalkStatus
from pdr_nodes.convert_mode import mode_message
from pdr_nodes.convert_walk import walk_records
from pdr_nodes.driver_calls import DriverCalls
from pdr_nodes.hearing import Hearing
from pdr_nodes.managed import ManagedNode
from pdr_nodes.notice_board import NO_DRIVER, NO_INPUT
from pdr_nodes.qos import ANSWERS, MODES
from pdr_nodes.run import run

PERIOD_S = 1.0  # of what is said where nothing changes
LOOK_S = 0.1
LEAVE_S = 0.2
SILENT = "nothing was heard of the walk for {:g} s: do the driver and gait_dr run?"


class ModeManagerNode(ManagedNode):
    """Hosts the mode manager and the energy model."""

    NAME = "mode_manager"
    GROUPS = ("power", "node")

    def set_up(self, params: Params) -> None:
        """Hear of the walk, call the driver, say what navigates."""
        self._supervision = Supervision(params.power)
        self._calls = DriverCalls(self, params.power.answer_timeout_s, self._answered, self._supervision.rated)
        self._silent_s, self._silent = params.power.silent_s, SILENT.format(params.power.silent_s)
        self._heard_s: float | None = None  # None: not yet, or not since it was taken to be gone
        self._modes = self.output(NavigationMode, "mode", MODES)
        self.part(Hearing(self, WalkStatus, "walk", self._walked, ANSWERS))
        self.every(PERIOD_S, self._say)
        self.every(LOOK_S, self._look)
        self.tell("driver", self._notices)

    def take_leave(self) -> None:
        """Leave no gyro off: the call needs a moment to get away."""
        if self.state == "active":
            self._calls.end()
            time.sleep(LEAVE_S)

    def _walked(self, message: WalkStatus) -> None:
        self._heard_s = time.monotonic()
        self._obey(self._supervision.walk(*walk_records(message)))

    def _answered(self, command: ModeCommand, answer: DriverAnswer) -> None:
        self._obey(self._supervision.answered(command, answer))

    def _obey(self, commands: list[ModeCommand]) -> None:
        """Say what is new, and ask for the newest command: of those before it nothing is left to do."""
        for report in self._supervision.news():
            self._modes.publish(mode_message(report))
        if commands:
            self._calls.ask(commands[-1])

    def _look(self) -> None:
        """Look whether the driver is still there."""
        if self._heard_s is not None and time.monotonic() - self._heard_s > self._silent_s:
            self._heard_s = None
            self._obey(self._supervision.lost(self._silent))

    def _say(self) -> None:
        self._modes.publish(mode_message(self._supervision.report))

    def _notices(self) -> list[Notice]:
        found = [] if self._heard_s is not None else [Notice(Level.WARN, f"{NO_INPUT}_walk", self._silent, 1, 0)]
        found += [] if self._calls.offered else [Notice(Level.WARN, NO_DRIVER, self._calls.nobody, 1, 0)]
        return [*found, *self._supervision.notices]


def main() -> None:
    """Run the node."""
    run(ModeManagerNode)


if __name__ == "__main__":
    main()
