"""How far two feet have brought the person, also where only one of them was there."""

from collections.abc import Mapping, Sequence

from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.result import Result
from pdr_core.evaluation.words import duration
from pdr_core.pipeline import FootOutput
from pdr_core.records import Level, Notice, length

SLACK_NS = NANOSECONDS  # recordings of one walk hardly end in one moment


class FeetTogether:
    """Hears what is told of two feet: the span of each, and where its strides end."""

    def __init__(self, feet: Sequence[str]) -> None:
        self._spans_ns: dict[str, tuple[int, int]] = {}
        self._strides: dict[str, list[tuple[int, float]]] = {foot: [] for foot in feet}  # stamp, length [m]

    def keep(self, foot: str, output: FootOutput) -> None:
        """Take the next estimates and steps of a foot."""
        self._strides[foot] += [(step.stamp_ns, step.length_m) for step in output.steps]
        if length(output.nav):
            first_ns, last_ns = int(output.nav.stamp_ns[0]), int(output.nav.stamp_ns[-1])
            self._spans_ns[foot] = self._spans_ns.get(foot, (first_ns, 0))[0], last_ns

    def totals(self, feet: Mapping[str, Result]) -> tuple[int, float]:
        """Return strides and distance [m] of the person: the feet's mean, and in full what one did alone."""
        alone_m = [length_m for foot in self._strides for length_m in self._alone_m(foot)]
        strides = sum(foot.strides for foot in feet.values()) + len(alone_m)
        return round(strides / len(feet)), (sum(foot.distance_m for foot in feet.values()) + sum(alone_m)) / len(feet)

    @property
    def notices(self) -> list[Notice]:
        """Which foot was not there all the time."""
        if not self._overlap:
            return []
        begins_ns, ends_ns = zip(*self._spans_ns.values(), strict=True)
        first_ns, last_ns = min(begins_ns), max(ends_ns)
        found = []
        for foot, (begin_ns, end_ns) in self._spans_ns.items():
            missing_ns = begin_ns - first_ns + last_ns - end_ns
            if missing_ns > SLACK_NS:
                missing = duration(missing_ns / NANOSECONDS)
                text = f"{foot} has no samples for {missing}: there the other foot alone counts"
                at_ns = end_ns if begin_ns == first_ns else first_ns
                found.append(Notice(Level.WARN, "one_foot_alone", text, 1, at_ns))
        return found

    def _alone_m(self, foot: str) -> list[float]:
        """Return the lengths of the strides that end where the other foot has not begun, or has ended."""
        if not self._overlap:
            return []
        ((begin_ns, end_ns),) = (span for other, span in self._spans_ns.items() if other != foot)
        return [m for at_ns, m in self._strides[foot] if not begin_ns - SLACK_NS <= at_ns <= end_ns + SLACK_NS]

    @property
    def _overlap(self) -> bool:
        """Both are there at one time; not so where their clocks count from different moments."""
        spans = list(self._spans_ns.values())
        return len(spans) > 1 and max(begin for begin, _ in spans) < min(end for _, end in spans)
