"""Which feet still owe estimates: their steps wait for an answer, and that for the other foot, which may have ended."""

from collections.abc import Mapping

from pdr_core.params import Params
from pdr_core.rate_limit import RateLimit
from pdr_nodes.convert import header_stamp_ns


class Owed:
    """Hears verdicts and estimates of feet, by their namespace below that of the run."""

    def __init__(self, feet: Mapping[str, Params]) -> None:
        self._limits = {foot: RateLimit(params.node.odom_rate_hz) for foot, params in feet.items()}
        self._due_ns: dict[str, int] = {}  # of the last verdict of a foot whose estimate is said
        self._told_ns: dict[str, int] = {}  # of its last estimate

    def hear(self, topic: str, cdr: bytes) -> None:
        """Take one message."""
        foot, _, name = topic.rpartition("/")
        if foot in self._limits and name == "odom":
            self._told_ns[foot] = header_stamp_ns(cdr)
        elif foot in self._limits and name == "stance" and self._limits[foot].allows(stamp_ns := header_stamp_ns(cdr)):
            self._due_ns[foot] = stamp_ns

    @property
    def by(self) -> set[str]:
        """The feet whose last estimate has not come."""
        return {foot for foot, due_ns in self._due_ns.items() if self._told_ns.get(foot) != due_ns}
