"""The stress test: seeded walks of mixed gaits, with consumer sensors and with what goes wrong.

Each is scored by its ATE2 in percent of the distance. A trouble that hides the motion parts the track, for nobody can
know how the foot went on: the parts before it, and after two strides of good stance behind it, are aligned each by
itself, and the worse one counts. The suite is told nothing of a sensor but the ranges on its data sheet.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from pdr_core.bench.stress_ranges import FAILED_PERCENT, RANGES
from pdr_core.bench.stress_trouble import ordeal
from pdr_core.bench.stress_walk import NO_TROUBLE, Drawn, drawn
from pdr_core.evaluation.metrics import ate2_m, path_length_m, percent
from pdr_core.pipeline import FootInertial
from pdr_core.records import joined

BANDS_HZ = ((100.0, 200.0), (200.0, 400.0), (400.0, 1000.0))


@dataclass(frozen=True)
class StressResult:
    """One walk."""

    drawn: Drawn
    distance_m: float
    ate2_percent: tuple[float, ...]  # of each part
    notices: tuple[str, ...]

    @property
    def worst_percent(self) -> float:
        """The worse part; infinite where the track is no number."""
        return max(x if np.isfinite(x) else np.inf for x in self.ate2_percent)

    @property
    def failed(self) -> bool:
        """Whether the track is too far from the truth."""
        return self.worst_percent > FAILED_PERCENT


@dataclass(frozen=True)
class StressRow:
    """The figures of all walks of one kind, in percent of the distance."""

    kind: str
    walks: int
    failed: int
    median_percent: float
    high_percent: float  # 95th percentile
    worst_percent: float


def stress(seeds: Sequence[int], seen: Callable[[str], object] = str) -> list[StressResult]:
    """Run the walks of these seeds; `seen` is told how many are done."""
    results = []
    for seed in seeds:
        results.append(result(drawn(seed)))
        seen(f"{len(results)} of {len(seeds)}")
    return results


def result(d: Drawn) -> StressResult:
    """Run the walk that was drawn through the whole chain."""
    it, chain = ordeal(d), FootInertial(d.told)
    nav = joined([chain.run(it.imu).nav, chain.finish().nav])
    row = np.searchsorted(it.imu.stamp_ns, nav.stamp_ns)
    scores = []
    for first, stop in it.parts:
        here = (row >= first) & (row < stop)
        true_m = it.position_m[row[here]]
        scores.append(percent(ate2_m(nav.position_m[here], true_m), path_length_m(true_m)))
    return StressResult(d, path_length_m(it.position_m), tuple(scores), tuple(n.kind for n in chain.notices))


def summary(results: Sequence[StressResult]) -> list[StressRow]:
    """Return the figures of all walks, of those with each trouble and of those in each band of rates."""
    kinds = {"all": list(results)}
    for name in (NO_TROUBLE.name, *(trouble.name for trouble in RANGES.troubles)):
        kinds[f"trouble: {name}"] = [r for r in results if r.drawn.trouble.name == name]
    for low, high in BANDS_HZ:
        kinds[f"{low:.0f} to {high:.0f} Hz"] = [r for r in results if low <= r.drawn.rate_hz < high]
    return [figures(kind, some) for kind, some in kinds.items() if some]


def figures(kind: str, results: Sequence[StressResult]) -> StressRow:
    """Return the figures of some walks, at least one."""
    worst = np.array([r.worst_percent for r in results])
    median, high, highest = (float(np.percentile(worst, q, method="higher")) for q in (50.0, 95.0, 100.0))
    return StressRow(kind, len(results), sum(r.failed for r in results), median, high, highest)
