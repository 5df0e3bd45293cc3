"""What the walks with somebody else's fixes add up to over seeds, and whether their covariances are honest."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pdr_core.bench.consistency import Spread, nees, spread
from pdr_core.bench.external_walks import (
    GOOD,
    LENGTH_M,
    AidedTrack,
    ExternalTrial,
    external_walk,
    moved_m,
    silenced,
    trials,
    unaided,
)
from pdr_core.records import Floats

SETTLED_S = 5.0  # after the frames were aligned
LET_GO = "external_let_go"


@dataclass(frozen=True)
class ExternalRow:
    """One kind of source over its walks: errors of the foot's place in their frame, once it is known."""

    source: str
    walks: int
    aligned_s: float  # median
    rms_m: float  # mean over walks
    worst_m: float
    moved_m: float  # farthest from the track with a source that says nothing in place of what is wrong, when that ends
    let_go: int  # walks in which it was


class ExternalFigures(NamedTuple):
    """All of it."""

    rows: list[ExternalRow]
    unaided_rms_m: float
    unaided_worst_m: float
    consistency: list[Spread]


def external_walks(
    walks: int, length_m: float = LENGTH_M, seen: Callable[[str], object] = str, names: Sequence[str] = ()
) -> ExternalFigures:
    """Walk with the seeds 0, 1, 2 ... and every kind of source, or those named; `seen` is told which."""
    found: dict[str, list[tuple[AidedTrack, float]]] = {}
    alone, squares = [], []
    for seed in range(walks):
        for trial in trials(seed, length_m):
            if names and trial.name not in names:
                continue
            seen(f"{trial.name}, {seed + 1} of {walks}")
            track = external_walk(trial)
            found.setdefault(trial.name, []).append((track, pulled_m(trial, track)))
            if trial.name == GOOD:
                alone.append(unaided(trial, track.frame).error_m)
                squares.append(normalised_squares(track))
    rows = [row(name, tracks) for name, tracks in found.items()]
    worst_m = max(float(np.nanmax(error_m)) for error_m in alone)
    return ExternalFigures(rows, float(np.mean([rms(e) for e in alone])), worst_m, spreads(squares))


def pulled_m(trial: ExternalTrial, track: AidedTrack) -> float:
    """Return by how much what was wrong has moved the foot at most, until the source was let go or was right again."""
    if silenced(trial) == trial:
        return 0.0
    let_go = [n.first_stamp_ns * 1e-9 for n in track.notices if n.kind == LET_GO]
    until = track.time_s <= let_go[0] + SETTLED_S if let_go else track.time_s < np.inf
    return float(moved_m(track, external_walk(silenced(trial)))[until].max())


def row(name: str, found: list[tuple[AidedTrack, float]]) -> ExternalRow:
    """Return the figures of one kind of source."""
    errors = [track.error_m for track, _ in found]
    return ExternalRow(
        name,
        len(found),
        float(np.median([track.aligned_s for track, _ in found])),
        float(np.mean([rms(error_m) for error_m in errors])),
        max(float(np.nanmax(error_m)) for error_m in errors),
        max(moved for _, moved in found),
        sum(any(n.kind == LET_GO for n in track.notices) for track, _ in found),
    )


def rms(error_m: Floats) -> float:
    """Return the root of the mean square of errors, those that are none left out."""
    return float(np.sqrt(np.nanmean(error_m**2)))


def normalised_squares(track: AidedTrack) -> dict[str, Floats]:
    """Return those of the place in their frame, by the filter's covariance and by that and the frame's.

    NaN before the frames were aligned, (n,) each.
    """
    assert track.frame is not None
    known = track.time_s >= track.aligned_s + SETTLED_S
    error_m = track.theirs_m - track.truth_m
    of_frame = np.array([track.frame.place_covariance_m2(place_m) for place_m in track.ours_m])
    alone, both = nees(error_m, track.covariance_m2), nees(error_m, track.covariance_m2 + of_frame)
    return {"place": np.where(known, alone, np.nan), "place, frame included": np.where(known, both, np.nan)}


def spreads(squares: list[dict[str, Floats]]) -> list[Spread]:
    """Compare them with both bounds, at every moment that all walks have."""
    out = []
    for name in squares[0]:
        shortest = min(len(one[name]) for one in squares)
        out.append(spread(name, 2, np.array([one[name][:shortest] for one in squares])))
    return out
