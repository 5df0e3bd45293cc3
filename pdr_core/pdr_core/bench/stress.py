"""The stress test: seeded walks of mixed gaits, with consumer sensors and with what goes wrong.

Each is scored by its ATE2 in percent of the distance. A trouble that hides the motion parts the track, for nobody can
know how the foot went on: the parts before it, and after two strides of good stance behind it, are aligned each by
itself, and the worse one counts.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from pdr_core.bench.stress_ranges import FAILED_PERCENT, Ranges
from pdr_core.bench.stress_trouble import ordeal
from pdr_core.bench.stress_walk import Drawn, drawn
from pdr_core.evaluation.metrics import ate2_m, path_length_m, percent
from pdr_core.pipeline import FootInertial
from pdr_core.records import joined

RATE_BANDS_HZ = (100.0, 200.0, 400.0, 1000.0)


@dataclass(frozen=True)
class StressResult:
    """One walk."""

    drawn: Drawn
    distance_m: float
    ate2_percent: tuple[float, ...]  # of each part
    notices: tuple[str, ...]

    @property
    def worst_percent(self) -> float:
        """The worse part; infinite where the filter is lost altogether."""
        return max(x if np.isfinite(x) else np.inf for x in self.ate2_percent)

    @property
    def failed(self) -> bool:
        """Whether the track is too far from the truth."""
        return self.worst_percent > FAILED_PERCENT


@dataclass(frozen=True)
class StressSummary:
    """All walks: figures in percent of the distance, and how many failed of how many, by trouble and by rate."""

    walks: int
    failed: int
    median_percent: float
    high_percent: float  # 95th percentile
    worst_percent: float
    by_trouble: dict[str, tuple[int, int]]
    by_rate: dict[str, tuple[int, int]]


def stress(seeds: Sequence[int], seen: Callable[[str], object] = str) -> list[StressResult]:
    """Run the walks of these seeds; `seen` is told how many are done."""
    results = []
    for seed in seeds:
        results.append(result(drawn(seed)))
        seen(str(len(results)))
    return results


def result(d: Drawn, ranges: Ranges | None = None) -> StressResult:
    """Run the walk that was drawn through the whole chain."""
    it = ordeal(d, ranges)
    chain = FootInertial(d.told)
    nav = joined([chain.run(it.imu).nav, chain.finish().nav])
    row = np.searchsorted(it.imu.stamp_ns, nav.stamp_ns)
    scores = []
    for first, stop in it.parts:
        here = (row >= first) & (row < stop)
        true_m = it.position_m[row[here]]
        scores.append(percent(ate2_m(nav.position_m[here], true_m), path_length_m(true_m)))
    return StressResult(d, path_length_m(it.position_m), tuple(scores), tuple(n.kind for n in chain.notices))


def summary(results: Sequence[StressResult]) -> StressSummary:
    """Return the figures of all walks."""
    worst = np.array([r.worst_percent for r in results])
    median, high = (float(x) for x in np.percentile(worst, [50.0, 95.0]))
    failed = sum(r.failed for r in results)
    by_trouble, by_rate = (failures(results, kind) for kind in (trouble_of, band_of))
    return StressSummary(len(results), failed, median, high, float(worst.max()), by_trouble, by_rate)


def failures(results: Sequence[StressResult], kind: Callable[[StressResult], str]) -> dict[str, tuple[int, int]]:
    """Return failures and walks of each kind."""
    kinds = sorted({kind(r) for r in results})
    of = {k: [r.failed for r in results if kind(r) == k] for k in kinds}
    return {k: (sum(flags), len(flags)) for k, flags in of.items()}


def trouble_of(result: StressResult) -> str:
    """Return what went wrong."""
    return result.drawn.trouble.name


def band_of(result: StressResult) -> str:
    """Return the band in which the rate lies."""
    i = int(np.searchsorted(RATE_BANDS_HZ, result.drawn.rate_hz, side="right"))
    return f"{RATE_BANDS_HZ[i - 1]:.0f} .. {RATE_BANDS_HZ[min(i, len(RATE_BANDS_HZ) - 1)]:.0f} Hz"
