"""What `pdr bench --dual` has measured: as tables, as JSON, as a page with pictures."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from pdr_bringup_scripts.benches.suite_tables import console, table, write_page
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench.dual_tables import DualRow, repeated, row
from pdr_core.bench.dual_walks import DualWalk, FootTrack
from pdr_core.evaluation.dual_page import DrawnFeet, dual_page
from pdr_core.evaluation.dual_plots import Curve
from pdr_core.evaluation.qiu_page import TitledTable
from pdr_core.evaluation.result import plain

FILES = "dual.html, dual.json"
HOW = ("alone", "together")
FEET = ("left", "right")


def as_json(walks: Sequence[DualWalk]) -> str:
    """Return every figure as one JSON object."""
    found = {"rows": [asdict(r) | {"ratio": r.ratio} for r in rows(walks)], "walks": [ends(w) for w in walks]}
    return json.dumps(plain(found), indent=2, allow_nan=False)


def rows(walks: Sequence[DualWalk]) -> list[DualRow]:
    """Return the figures of each walk."""
    return [row(each) for each in repeated(walks)]


def ends(walk: DualWalk) -> dict[str, object]:
    """Return by how much the ends of one walk are off [m]."""
    errors = {how: {f: getattr(walk, how)[f].end_error_m.tolist() for f in FEET} for how in HOW}
    return asdict(walk.trial) | {"end_error_m": errors}


def show(walks: Sequence[DualWalk]) -> None:
    """Print the tables."""
    out = console()
    for one in tables(rows(walks)):
        printed = table(one.title, *one.heads, names=2)
        for cells in one.rows:
            printed.add_row(*cells)
        out.print(printed)


def tables(found: Sequence[DualRow]) -> list[TitledTable]:
    """Return all tables as text."""
    return [end_table(found), lateral_table([r for r in found if r.straight])]


def end_table(found: Sequence[DualRow]) -> TitledTable:
    """Return how far off the walks end."""
    heads = ("walk", "errors", "walks", "alone m", "together m", "ratio", "worst alone m", "worst together m")
    cells = [
        (r.walk, r.errors, str(r.repetitions), f"{r.end_error_alone_m:.2f}", f"{r.end_error_together_m:.2f}",
         f"{r.ratio:.2f}", f"{r.worst_alone_m:.2f}", f"{r.worst_together_m:.2f}")
        for r in found
    ]  # fmt: skip
    return TitledTable("End errors: means over walks and feet", heads, cells)


def lateral_table(found: Sequence[DualRow]) -> TitledTable:
    """Return how far beside the straight way each foot ends, and how far its mean may be from zero by chance."""
    heads = ("errors", "foot", "alone m", "together m", "2 sigma / sqrt(n) m")
    cells = [
        (r.errors, foot, spread(r.lateral_alone_m[foot]), spread(r.lateral_m[foot]), f"{r.lateral_bound_m(foot):.2f}")
        for r in found
        for foot in FEET
    ]
    return TitledTable("Lateral end errors of the straight walk: mean and deviation", heads, cells)


def spread(mean_sd: tuple[float, float]) -> str:
    """Return mean and standard deviation."""
    return f"{mean_sd[0]:+.2f} ± {mean_sd[1]:.2f}"


def write_files(out: Path, walks: Sequence[DualWalk]) -> None:
    """Write the page and the figures into a folder that exists."""
    drawn = [drawn_feet(each) for each in repeated(walks)]
    page = dual_page(tables(rows(walks)), drawn, VERSION, commit())
    write_page(out, FILES, page, as_json(walks))


def drawn_feet(walks: Sequence[DualWalk]) -> DrawnFeet:
    """Return the curves of one walk over its repetitions."""
    found = [(foot, how, [getattr(w, how)[foot] for w in walks]) for how in HOW for foot in FEET]
    mean_tracks = [Curve(foot, how, *mean_m([t.position_m for t in each])) for foot, how, each in found]
    truths = [Curve("truth", "", *mean_m([w.alone[foot].truth_m for w in walks])) for foot in FEET]
    last = [Curve(foot, how, *np.array([t.end_error_m for t in each]).T) for foot, how, each in found]
    drifts = [Curve(foot, how, *drift_deg(each)) for foot, how, each in found]
    drifts += [walking_direction(how, *pair) for how, pair in zip(HOW, (drifts[:2], drifts[2:]), strict=True)]
    found_row = row(walks)
    return DrawnFeet(
        f"{found_row.walk}, errors {found_row.errors}", found_row.straight, [*truths, *mean_tracks], last, drifts
    )


def mean_m(tracks: Sequence[np.ndarray]) -> np.ndarray:
    """Return the mean of tracks (n, 2) as rows x and y, (2, n)."""
    return np.mean(tracks, axis=0).T


def drift_deg(tracks: Sequence[FootTrack]) -> tuple[np.ndarray, np.ndarray]:
    """Return when strides end [s] and their mean heading error [deg], as far as every repetition goes."""
    shortest = min(len(t.stride_s) for t in tracks)
    error_rad = np.mean([t.heading_error_rad[:shortest] for t in tracks], axis=0)
    return tracks[0].stride_s[:shortest], np.degrees(error_rad)


def walking_direction(how: str, left: Curve, right: Curve) -> Curve:
    """Return the mean of both feet at the strides of the left one (eq. 6)."""
    return Curve("direction", how, left.x, 0.5 * (left.y + np.interp(left.x, right.x, right.y)))
