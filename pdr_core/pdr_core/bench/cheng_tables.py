"""Cheng's Table 2 over many seeds, what K costs in the real loop, and 100 m without a stop."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pdr_core.bench.cheng_walks import CASES_M, METHODS, ChengResult, ChengWalk, Walked, by_every_method, walk, walked
from pdr_core.chest.loop_error import LoopNoise, rms_rad
from pdr_core.params import Params, changed

SEEDS = 20
GAIN_CASE = 2
GAINS_PER_S = {
    "improved": (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0),
    "traditional": (0.0, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0),
}
GAIN_NAMES = {"improved": "feedback_per_s", "traditional": "traditional_feedback_per_s"}
LONG_M = 100.0
LONG = {"step_length": "model"}


@dataclass(frozen=True)
class ChengRow:
    """One case by one method over all seeds; case 0: all of them."""

    case: int
    method: str
    walks: int
    end_error_m: float  # mean
    end_error_percent: float  # mean
    largest_percent: float
    footfall_error_m: float  # mean
    tilt_error_deg: float  # root mean square


@dataclass(frozen=True)
class GainPoint:
    """One K in the real loop over all seeds."""

    method: str
    gain_per_s: float
    tilt_error_deg: float  # root mean square
    expected_deg: float | None  # by loop_error.py; None: it knows nothing of this filter
    end_error_m: float  # mean


class ChengBench(NamedTuple):
    """All that was measured, and the first seed's tracks."""

    results: list[ChengResult]
    gains: list[GainPoint]
    long: list[ChengResult]
    drawn: list[Walked]


def cheng(seeds: int = SEEDS, seen: Callable[[str], object] = str) -> ChengBench:
    """Walk everything with the seeds 1, 2, 3 ...; `seen` is told which."""
    results, drawn = [], []
    for case in range(1, len(CASES_M) + 1):
        for seed in range(1, seeds + 1):
            seen(f"case {case}, {seed} of {seeds}")
            found = list(by_every_method(walk(case, seed)))
            results += [one.result for one in found]
            drawn += found if seed == 1 else []
    return ChengBench(results, gains(seeds, seen), long_walks(seeds, seen), drawn)


def long_walks(seeds: int, seen: Callable[[str], object] = str) -> list[ChengResult]:
    """Walk 100 m without a stop, after a stretch of 10 m, with a step length model that is learnt on the way."""
    found = []
    for seed in range(1, seeds + 1):
        seen(f"{LONG_M:.0f} m, {seed} of {seeds}")
        one = walk(0, seed, LONG_M, "straight")
        found.append(walked(one, "model", changed(Params(), "chest", **LONG)).result)
    return found


def gains(seeds: int, seen: Callable[[str], object] = str) -> list[GainPoint]:
    """Walk one case with every K of both filters."""
    walks = [walk(GAIN_CASE, seed) for seed in range(1, seeds + 1)]
    found = []
    for method, values in GAINS_PER_S.items():
        for gain in values:
            seen(f"K of the {method} filter: {gain:g}")
            found.append(gain_point(walks, method, gain))
    return found


def gain_point(walks: Sequence[ChengWalk], method: str, gain_per_s: float) -> GainPoint:
    """Walk with one K."""
    chest = {**METHODS["ICFWSLC"], "method": method, GAIN_NAMES[method]: gain_per_s}
    params = changed(Params(), "chest", **chest)
    found = [walked(one, method, params).result for one in walks]
    expected_deg = float(np.degrees(rms_rad(gain_per_s, LoopNoise()))) if method == "improved" else None
    end_m = float(np.mean([r.end_error_m for r in found]))
    return GainPoint(method, gain_per_s, rms([r.tilt_error_deg for r in found]), expected_deg, end_m)


def best(points: Sequence[GainPoint], method: str) -> float:
    """Return the K of least attitude error: the vertex of the parabola through the best point and its neighbours."""
    own = [p for p in points if p.method == method]
    i = int(np.clip(np.argmin([p.tilt_error_deg for p in own]), 1, len(own) - 2))
    gain, error = zip(*[(p.gain_per_s, p.tilt_error_deg) for p in own[i - 1 : i + 2]], strict=True)
    square, slope, _ = np.polyfit(gain, error, 2)
    return float(np.clip(-slope / (2.0 * square), gain[0], gain[2])) if square > 0.0 else float(gain[np.argmin(error)])


def rows(results: Sequence[ChengResult]) -> list[ChengRow]:
    """Return a row for every method of every case, and of all cases."""
    cases = [*dict.fromkeys(r.case for r in results), 0]
    methods = dict.fromkeys(r.method for r in results)
    return [row([r for r in results if r.method == m and case in (0, r.case)], case) for case in cases for m in methods]


def row(found: Sequence[ChengResult], case: int) -> ChengRow:
    """Return the row of one method's walks."""
    percents = [r.end_error_percent for r in found]
    return ChengRow(
        case=case,
        method=found[0].method,
        walks=len(found),
        end_error_m=float(np.mean([r.end_error_m for r in found])),
        end_error_percent=float(np.mean(percents)),
        largest_percent=max(percents),
        footfall_error_m=float(np.mean([r.footfall_error_m for r in found])),
        tilt_error_deg=rms([r.tilt_error_deg for r in found]),
    )


def better_percent(found: Sequence[ChengRow], than: str, method: str = "ICFWSLC") -> float:
    """Return by how much the mean end error over all cases is less than that of another method."""
    ends = {r.method: r.end_error_m for r in found if r.case == 0}
    return 100.0 * (1.0 - ends[method] / ends[than])


def rms(values: Sequence[float]) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))
