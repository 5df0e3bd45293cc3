"""What the dual-foot walks add up to: end errors, lateral errors and drift over seeds, against what is promised."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pdr_core.bench.dual_walks import REPETITIONS, STRAIGHT_M, DualTrial, DualWalk, FootTrack, dual_walk
from pdr_core.records import Floats

# name, length: paper 004's walk, then with turns and curves
STRAIGHT = ("straight", STRAIGHT_M)
WALKS = (STRAIGHT, ("corridor", STRAIGHT_M), ("rectangle", STRAIGHT_M), ("curve", STRAIGHT_M), ("curve", 300.0))
ERRORS = ("mirrored", "alike")
FEET = ("left", "right")


@dataclass(frozen=True)
class DualRow:
    """One walk over its repetitions, both feet together; lateral errors of the straight walk for each foot."""

    walk: str  # its name
    straight: bool
    errors: str
    repetitions: int
    end_error_alone_m: float  # mean over repetitions and feet
    end_error_together_m: float
    worst_alone_m: float
    worst_together_m: float
    lateral_m: Mapping[str, tuple[float, float]]  # of a foot, corrected: mean and standard deviation of y at the end
    lateral_alone_m: Mapping[str, tuple[float, float]]

    @property
    def ratio(self) -> float:
        """Mean end error together beside that alone."""
        return self.end_error_together_m / self.end_error_alone_m

    def lateral_bound_m(self, foot: str) -> float:
        """How far from zero the mean lateral error may be by chance: two standard errors."""
        return 2.0 * self.lateral_m[foot][1] / float(np.sqrt(self.repetitions))


def dual_walks(repetitions: int = REPETITIONS, seen: Callable[[str], object] = str) -> list[DualWalk]:
    """Walk every walk with every kind of errors; `seen` is told which."""
    found = []
    for trial in (DualTrial(*walk, errors, seed) for walk in WALKS for errors in ERRORS for seed in range(repetitions)):
        seen(f"{trial.name}, errors {trial.errors}, {trial.seed + 1} of {repetitions}")
        found.append(dual_walk(trial))
    return found


def repeated(walks: Sequence[DualWalk]) -> list[list[DualWalk]]:
    """Return the repetitions of each walk and kind of errors that there is."""
    kinds: dict[tuple[str, str], list[DualWalk]] = {}
    for walk in walks:
        kinds.setdefault((walk.trial.name, walk.trial.errors), []).append(walk)
    return list(kinds.values())


def row(walks: Sequence[DualWalk]) -> DualRow:
    """Return the figures of one walk over its repetitions."""
    alone, together = ends_m([w.alone for w in walks]), ends_m([w.together for w in walks])
    off_alone_m, off_m = (np.linalg.norm(list(ends.values()), axis=-1) for ends in (alone, together))
    return DualRow(
        walks[0].trial.name,
        walks[0].trial.walk == STRAIGHT[0],
        walks[0].trial.errors,
        len(walks),
        float(off_alone_m.mean()),
        float(off_m.mean()),
        float(off_alone_m.max()),
        float(off_m.max()),
        {foot: mean_sd(ends[:, 1]) for foot, ends in together.items()},
        {foot: mean_sd(ends[:, 1]) for foot, ends in alone.items()},
    )


def ends_m(tracks: Sequence[Mapping[str, FootTrack]]) -> dict[str, Floats]:
    """Return by how much each foot's end is off, (repetitions, 2) by foot."""
    return {foot: np.array([track[foot].end_error_m for track in tracks]) for foot in FEET}


def mean_sd(values: Floats) -> tuple[float, float]:
    """Return mean and standard deviation; of a single value 0."""
    return float(values.mean()), float(values.std(ddof=1)) if len(values) > 1 else 0.0
