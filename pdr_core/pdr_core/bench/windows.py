"""How many steps a detector finds, by the length of its window, as Qiu shows it in figure 6.

A short window takes the wobble of a standing foot for swings, a long one loses the stances of a fast walk.
"""

from collections.abc import Callable, Sequence

import numpy as np

from pdr_core.bench.trial import Walk
from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.detector_study import WindowSteps
from pdr_core.intake import Ingestion
from pdr_core.params import Params, changed
from pdr_core.records import Flags, Floats, ImuBlock, joined, length
from pdr_core.stance import StanceDetection

SIZES = 25  # Qiu figure 6
LONGEST_S = 0.25
SHORTEST = 3  # intervals


def window_steps(
    walk: Walk, params: Params, detectors: Sequence[str], seen: Callable[[str], object] = str
) -> WindowSteps:
    """Count the swings between stances with windows of every length; `seen` is told whose."""
    imu = ingested(walk, params)
    window_s = lengths_s(imu)
    steps: dict[str, list[int]] = {}
    for detector in detectors:
        seen(f"windows of {detector}")
        steps[detector] = [swings(verdicts(imu, with_window(params, detector, float(w)))) for w in window_s]
    return WindowSteps(window_s, steps)


def ingested(walk: Walk, params: Params) -> ImuBlock:
    """Return the samples as they reach the detector: it has no say in that."""
    intake = Ingestion(params.intake)
    return joined([*map(intake.run, walk.pieces), intake.finish()])


def lengths_s(imu: ImuBlock) -> Floats:
    """Return the lengths of the windows [s], from three intervals on: a shorter one holds three samples as well."""
    interval_s = float(np.median(np.diff(imu.stamp_ns))) / NANOSECONDS if length(imu) > 1 else 0.0
    return np.linspace(min(SHORTEST * interval_s, LONGEST_S), LONGEST_S, SIZES, dtype=np.float64)


def with_window(params: Params, detector: str, window_s: float) -> Params:
    """Return the parameters with a detector and the length of its window."""
    chosen = changed(params, "stance", detector=detector)
    if detector == "adaptive":
        return changed(chosen, "stance", window_s=window_s)
    return changed(chosen, "detectors", **{f"{detector}_window_s": window_s})


def verdicts(imu: ImuBlock, params: Params) -> Flags:
    """Return the verdict on each sample, (n,)."""
    stage = StanceDetection(params.stance, params.place, params.detectors)
    return np.concatenate([stage.run(imu).stance, stage.finish().stance])


def swings(stance: Flags) -> int:
    """Return how often the foot leaves one stance and comes to another."""
    begins = np.count_nonzero(np.diff(stance.astype(np.int8), prepend=0) == 1)
    return max(0, int(begins) - 1)
