"""The mode manager's node on a bench, a person who walks before it, and a driver in a process of its own."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray

from pdr_core.conventions import NANOSECONDS
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import MeasuredStride, Sensed, Walk
from pdr_msgs.msg import NavigationMode, WalkStatus
from pdr_msgs.srv import SetGyroPower
from pdr_nodes.convert_walk import walk_message
from pdr_nodes.mode_manager_node import ModeManagerNode
from pdr_nodes.notice_board import notices_from
from pdr_nodes.qos import ANSWERS, MODES, STATUS
from pdr_nodes.run import serve
from support.bench import Bench
from support.processes import start

RECORD_S, STRIDE_S, STRIDE_M = 0.05, 1.0, 1.25
WALL_S = 0.01  # of a record: five times as fast as real
BEGIN_NS = 1_700_000_000 * NANOSECONDS


@contextmanager
def fake_driver(rig: "Rig", how: str, log: Path) -> Iterator[Path]:
    """Run a driver that answers as it was told; its log says what it was asked."""
    process = start(["-m", "support.fake_driver", f"/{rig.namespace}", how], log)
    try:
        rig.until(lambda: rig.offers_power.service_is_ready(), "the driver")
        yield log
    finally:
        process.kill()
        process.wait(120.0)


class Rig(Bench):
    """Every `RECORD_S` a record of the walk, a stride a second; its gyro is as the manager says that it is."""

    def __init__(self, namespace: str, answer_timeout_s: float = 2.0, duty: str = "none") -> None:
        params = {"power__calibration_m": 10.0, "power__answer_timeout_s": answer_timeout_s, "power__retry_s": 3.0}
        super().__init__(ModeManagerNode, namespace=namespace, **params, power__duty=duty)
        self.now_ns = BEGIN_NS
        self.longest_s = 0.0  # that the node has served one record
        self._records = 0
        self.gyro_on: bool | None = None  # None: as the manager says

    def __enter__(self) -> "Rig":
        super().__enter__()
        self.modes = self.hear(NavigationMode, "mode", MODES)
        self.said = self.hear(DiagnosticArray, "/diagnostics", STATUS)
        self.offers_power = self.me.create_client(SetGyroPower, "set_gyro_power")
        self._walk = self.publisher(WalkStatus, "walk", ANSWERS)
        return self

    @property
    def last(self) -> NavigationMode:
        return self.modes[-1]

    def walk(self, seconds: float) -> None:
        """Walk on."""
        for _ in range(round(seconds / RECORD_S)):
            self._step()

    def walk_until(self, condition, what: str, within_s: float = 60.0) -> NavigationMode:
        """Walk until it holds of what the node says, and return that; AssertionError says what never came."""
        first = max(0, len(self.modes) - 1)
        for _ in range(round(within_s / RECORD_S)):
            if found := [said for said in self.modes[first:] if condition(said)]:
                return found[0]
            self._step()
        raise AssertionError(f"walked {within_s:.0f} s without {what}; now {self.modes and self.last}")

    def kinds(self, first: int = 0) -> set[str]:
        """Return what the diagnostics have named of the driver, from one of them on."""
        statuses = [s for array in self.said[first:] for s in array.status if s.name.endswith("mode_manager: driver")]
        return {notice.kind for status in statuses for notice in notices_from(status.values)}

    def _step(self) -> None:
        self.now_ns += round(RECORD_S * NANOSECONDS)
        self._records += 1
        gyro = self.gyro_on if self.gyro_on is not None else not self.modes or self.last.gyro_powered
        strides, reckoned = (), 0
        if self._records % round(STRIDE_S / RECORD_S) == 0:
            begin_ns = self.now_ns - round(STRIDE_S * NANOSECONDS)
            measured = MeasuredStride(begin_ns, self.now_ns, STRIDE_M, STRIDE_M, 0.04)
            strides, reckoned = ((measured,), 0) if gyro else ((), 1)
        walk = Walk(self.now_ns, Behaviour.WALKING, True, True, False, strides, reckoned)
        self._walk.publish(walk_message(walk, Sensed(gyro, False, 200.0 if gyro else 50.0), "foot", False))
        end_s = time.monotonic() + WALL_S
        while time.monotonic() < end_s:
            begin_s = time.monotonic()
            serve(self.executor, self.node, 0.002)
            self.longest_s = max(self.longest_s, time.monotonic() - begin_s)
