"""What every time gate does: it holds verdicts back until their stance has lasted long enough to be believed."""

from abc import ABC, abstractmethod

from pdr_core.conventions import GAP_NS, NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.records import Flags, Stamps, StanceBlock, joined, part


class TimeGate(ABC):
    """Wraps any detector: a sample that it found in stance may turn out not to be; the others never change."""

    latency_s: float  # the longest time [s] for which a verdict is held back

    def __init__(self) -> None:
        self._waiting: list[StanceBlock] = []

    def run(self, judged: StanceBlock, final: bool) -> StanceBlock:
        """Return the samples, of these and earlier ones, whose verdict is certain now; all of them if `final`."""
        waiting = joined([*self._waiting, judged])
        stance = self.decide(waiting.imu.stamp_ns, waiting.stance, final)
        self._waiting = [part(waiting, len(stance))]
        return part(waiting, 0, len(stance))._replace(stance=stance)

    @abstractmethod
    def decide(self, stamp_ns: Stamps, resting: Flags, final: bool) -> Flags:
        """Return the verdicts on the first samples, (m,) of (n,): those that are certain. The others come again."""


@compiled
def after_gap(stamp_ns: int, before_ns: int) -> bool:
    """Return whether samples are missing between two stamps: then no stance goes on from one to the other."""
    return before_ns != NO_STAMP and stamp_ns - before_ns > GAP_NS


@compiled
def lasts(stamp_ns: Stamps, resting: Flags, start: int, needed_ns: int) -> tuple[bool, bool]:
    """Return whether the rest that begins at `start` lasts for `needed_ns`, and whether this is certain."""
    for i in range(start, stamp_ns.shape[0]):
        if not resting[i] or (i > start and after_gap(stamp_ns[i], stamp_ns[i - 1])):
            return False, True
        if stamp_ns[i] - stamp_ns[start] >= needed_ns:
            return True, True
    return False, False
