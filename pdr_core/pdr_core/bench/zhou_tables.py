"""Zhou section 5 anew over many seeds: everything that `pdr bench --zhou` measures."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields

import numpy as np

from pdr_core.bench.zhou_errors import LapResult, result
from pdr_core.bench.zhou_features import Features, features
from pdr_core.bench.zhou_lengths import LengthError, Lengths, figure_16
from pdr_core.bench.zhou_lesson import lesson
from pdr_core.bench.zhou_modes import Managed, Timeline, Transition, figure_15, ten_minutes
from pdr_core.bench.zhou_schemes import Track, at_rate
from pdr_core.bench.zhou_testers import TABLE_4_DEG, Found, Observed, found, tester
from pdr_core.bench.zhou_walks import RATES_HZ, WALKS, Octagon, Trial, octagon

SEEDS = 20
TESTER = "a"  # of all but Tables 4 and 6: the one whose foot points farthest outward
Seen = Callable[[str], object]


@dataclass
class Results:
    """The figures of all walks."""

    laps: list[LapResult] = field(default_factory=list)  # Tables 5, 7, 9
    found: list[Found] = field(default_factory=list)  # Table 4
    tester_laps: list[LapResult] = field(default_factory=list)  # Table 6
    managed: list[Managed] = field(default_factory=list)  # figure 15, and ten minutes
    transitions: list[Transition] = field(default_factory=list)
    lengths: list[LengthError] = field(default_factory=list)  # figure 16


@dataclass
class Drawn:
    """What can be drawn of the first seed."""

    octagons: dict[str, Octagon] = field(default_factory=dict)  # by gait
    tracks: dict[tuple[str, str, int], Track] = field(default_factory=dict)  # by gait, scheme and rate
    observed: dict[str, Observed] = field(default_factory=dict)
    features: list[Features] = field(default_factory=list)
    timeline: Timeline | None = None
    lengths: Lengths | None = None


def zhou_walks(seeds: int = SEEDS, seen: Seen = str) -> tuple[Results, Drawn]:
    """Walk everything with the seeds 1, 2, 3 ...; `seen` is told what."""
    results, drawn = Results(), Drawn()
    for seed in range(1, seeds + 1):
        for gait in WALKS:
            seen(f"octagon, {gait}, {seed} of {seeds}")
            laps(Trial(gait, TESTER, seed), results, drawn)
        for name in TABLE_4_DEG:
            seen(f"tester {name.upper()}, {seed} of {seeds}")
            known, two = tester(Trial("walking", name, seed))
            results.found.append(known)
            results.tester_laps += two
        seen(f"standing, walking, running, {seed} of {seeds}")
        through_all(seed, results, drawn)
    drawn.features = features(TESTER)
    return results, drawn


def laps(trial: Trial, results: Results, drawn: Drawn) -> None:
    """Walk the second lap by every scheme at every rate."""
    known = lesson(octagon(trial))
    if trial.seed == 1:
        drawn.octagons[trial.gait], drawn.observed[trial.gait] = known.octagon, found(known)[1]
    for rate_hz in RATES_HZ:
        for scheme, track in at_rate(known, rate_hz).items():
            results.laps.append(result(known.octagon, scheme, rate_hz, track))
            if trial.seed == 1:
                drawn.tracks[trial.gait, scheme, rate_hz] = track


def through_all(seed: int, results: Results, drawn: Drawn) -> None:
    """Walk through all behaviours, and for ten minutes."""
    walk, changes, timeline = figure_15(TESTER, seed)
    errors, lengths = figure_16(TESTER, seed)
    results.managed += [walk, ten_minutes(TESTER, seed)]
    results.transitions += changes
    results.lengths += errors
    if seed == 1:
        drawn.timeline, drawn.lengths = timeline, lengths


def mean(results: Sequence[LapResult]) -> LapResult:
    """Return the mean of all figures of laps that differ by their seeds alone."""
    numbers = [f.name for f in fields(LapResult) if f.type in ("float", float)]
    first = {f.name: getattr(results[0], f.name) for f in fields(LapResult)}
    return LapResult(**{**first, **{name: float(np.mean([getattr(r, name) for r in results])) for name in numbers}})


def of(results: Sequence[LapResult], **wanted: object) -> list[LapResult]:
    """Return the laps whose fields have these values."""
    return [r for r in results if all(getattr(r, name) == value for name, value in wanted.items())]
