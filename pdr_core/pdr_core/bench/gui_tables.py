"""Gui's Table 3 over many seeds: every variant on every walk, its end error, and how far that is from the floor."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from pdr_core.bench.gui_variants import FLOOR, VARIANTS
from pdr_core.bench.gui_walks import WALKS, GuiResult, Measured, by_every_variant

SEEDS = 50


@dataclass(frozen=True)
class GuiRow:
    """One walk by one variant over all seeds."""

    walk: str
    variant: str
    seeds: int
    distance_m: float
    end_x_m: float  # of the first seed
    end_y_m: float
    end_error_m: float  # mean
    end_error_percent: float  # mean
    largest_percent: float
    over_floor: float  # mean end error beside that with an ideal heading
    ate2_m: float  # mean
    yaw_error_deg: float  # at the end, root mean square
    miscounted: int  # strides, added up


def gui_walks(seeds: int = SEEDS, seen: Callable[[str], object] = str) -> tuple[list[GuiResult], list[Measured]]:
    """Walk every walk with the seeds 1, 2, 3 ... by every variant; `seen` is told which.

    Returns the figures of all, and of the first seed also the tracks.
    """
    results, drawn = [], []
    for walk in WALKS:
        for seed in range(1, seeds + 1):
            seen(f"{walk.name}, {seed} of {seeds}")
            found = list(by_every_variant(walk, seed))
            results += [one.result for one in found]
            drawn += found if seed == 1 else []
    return results, drawn


def of(results: Sequence[GuiResult], walk: str, variant: str) -> list[GuiResult]:
    """Return one walk by one variant."""
    return [r for r in results if (r.walk, r.variant) == (walk, variant)]


def rows(results: Sequence[GuiResult]) -> list[GuiRow]:
    """Return a row for every variant of every walk."""
    walks = dict.fromkeys(r.walk for r in results)
    return [row(results, walk, variant) for walk in walks for variant in VARIANTS]


def row(results: Sequence[GuiResult], walk: str, variant: str) -> GuiRow:
    """Return the row of a variant."""
    runs, floor_m = of(results, walk, variant), mean_end_error_m(of(results, walk, FLOOR))
    percents = [r.end_error_percent for r in runs]
    return GuiRow(
        walk=walk,
        variant=variant,
        seeds=len(runs),
        distance_m=runs[0].distance_m,
        end_x_m=runs[0].end_x_m,
        end_y_m=runs[0].end_y_m,
        end_error_m=mean_end_error_m(runs),
        end_error_percent=float(np.mean(percents)),
        largest_percent=max(percents),
        over_floor=mean_end_error_m(runs) / floor_m,
        ate2_m=float(np.mean([r.ate2_m for r in runs])),
        yaw_error_deg=float(np.sqrt(np.mean([r.yaw_error_deg**2 for r in runs]))),
        miscounted=sum(abs(r.strides - r.strides_true) for r in runs),
    )


def mean_end_error_m(results: Sequence[GuiResult]) -> float:
    """Return the mean distance of the end from the start."""
    return float(np.mean([r.end_error_m for r in results]))
