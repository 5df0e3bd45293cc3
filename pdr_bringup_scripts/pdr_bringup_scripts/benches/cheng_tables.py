"""What `pdr bench --cheng` has measured: as tables, as JSON, as a page with pictures."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from pdr_bringup_scripts.benches.suite_tables import show_titled, write_page
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench import cheng_gain
from pdr_core.bench.cheng_tables import LONG_M, ChengBench, ChengRow, GainPoint, best, better_percent, rows
from pdr_core.bench.cheng_walks import CASES_M, PAPER_M, TABLE_2, Walked
from pdr_core.evaluation.cheng_page import ChengDrawn, GainDrawn, cheng_page
from pdr_core.evaluation.cheng_plots import Line
from pdr_core.evaluation.motion_plots import MotionTrack
from pdr_core.evaluation.qiu_page import TitledTable
from pdr_core.evaluation.result import plain
from pdr_core.params import ChestParams

FILES = "cheng.html, cheng.json"
EVERY = 5  # rows of a track, at 100 Hz


def as_json(bench: ChengBench) -> str:
    """Return every figure as one JSON object."""
    found = rows(bench.results)
    return json.dumps(
        plain(
            {
                "table_2": [asdict(row) for row in found],
                "better_percent": {than: better_percent(found, than) for than in TABLE_2[:2]},
                "theory": [row._asdict() for row in cheng_gain.theory()],
                "gains": [asdict(point) for point in bench.gains],
                "best_gain_per_s": best(bench.gains, "improved"),
                "default_gain_per_s": ChestParams().feedback_per_s,
                "long": [asdict(r) for r in bench.long],
                "walks": [asdict(r) for r in bench.results],
            }
        ),
        indent=2,
    )


def show(bench: ChengBench) -> None:
    """Print the tables."""
    show_titled(tables(bench))


def tables(bench: ChengBench) -> list[TitledTable]:
    """Return all tables as text."""
    found = rows(bench.results)
    return [table_2(found), better(found), gain_table(bench.gains), theory_table(), long_table(bench)]


def table_2(found: Sequence[ChengRow]) -> TitledTable:
    """Return Cheng's Table 2."""
    heads = ("case", "method", "end error m", "%", "largest %", "at footfalls m", "tilt °", "paper m")
    walks = max(row.walks for row in found if row.case)
    title = f"Cheng Table 2: five rectangles of 32 to 48 m, mean of {walks} walks each"
    return TitledTable(title, heads, [table_2_row(row) for row in found])


def table_2_row(row: ChengRow) -> tuple[str, ...]:
    """Return the figures of a row."""
    name = f"{row.case} ({CASES_M[row.case - 1]:.0f} m)" if row.case else "all"
    percents = (f"{row.end_error_percent:.2f}", f"{row.largest_percent:.2f}")
    figures = (f"{row.end_error_m:.2f}", *percents, f"{row.footfall_error_m:.2f}", f"{row.tilt_error_deg:.3f}")
    return name, row.method, *figures, paper(row)


def paper(row: ChengRow) -> str:
    """Return what the paper has for a row."""
    of_method = PAPER_M.get(row.method)
    if of_method is None:
        return ""
    return f"{of_method[row.case - 1] if row.case else np.mean(of_method):.2f}"


def better(found: Sequence[ChengRow]) -> TitledTable:
    """Return by how much the improved method is better."""
    of_paper = {than: 100.0 * (1.0 - np.mean(PAPER_M["ICFWSLC"]) / np.mean(PAPER_M[than])) for than in TABLE_2[:2]}
    lines = [(than, f"{better_percent(found, than):.1f}", f"{of_paper[than]:.1f}") for than in TABLE_2[:2]]
    return TitledTable("Mean end error of ICFWSLC, less by %", ("than", "here", "paper's means"), lines)


def gain_table(points: Sequence[GainPoint]) -> TitledTable:
    """Return what K costs in the real loop."""
    title = f"K in the real loop: best {best(points, 'improved'):.2f}/s, default {ChestParams().feedback_per_s:.2f}/s"
    lines = [
        (p.method, f"{p.gain_per_s:g}", f"{p.tilt_error_deg:.3f}", known(p.expected_deg), f"{p.end_error_m:.2f}")
        for p in points
    ]
    return TitledTable(title, ("filter", "K 1/s", "tilt °", "expected °", "end error m"), lines)


def known(value: float | None) -> str:
    """Return a figure that may be unknown."""
    return "" if value is None else f"{value:.3f}"


def theory_table() -> TitledTable:
    """Return the minimum of the paper's objective."""
    lines = [
        (f"{row.period_s:g}", f"{row.closed_form:.4g}", f"{row.searched:.4g}", f"{row.error_deg:.4f}")
        for row in cheng_gain.theory()
    ]
    return TitledTable("K by eq. 18, with the paper's numbers", ("T s", "closed form", "search", "error °"), lines)


def long_table(bench: ChengBench) -> TitledTable:
    """Return how well a long walk is walked."""
    errors = [r.end_error_m for r in bench.long]
    heads = ("walks", "mean end error m", "largest m", "within 5 %")
    within = f"{sum(e <= 0.05 * LONG_M for e in errors)} of {len(errors)}"
    line = (str(len(errors)), f"{np.mean(errors):.2f}", f"{max(errors):.2f}", within)
    return TitledTable(f"{LONG_M:.0f} m without a stop", heads, [line])


def write_files(out: Path, bench: ChengBench) -> None:
    """Write the page and the figures into a folder that exists."""
    page = cheng_page(tables(bench), cases(bench.drawn), drawn_gain(bench), VERSION, commit())
    write_page(out, FILES, page, as_json(bench))


def cases(drawn: Sequence[Walked]) -> list[ChengDrawn]:
    """Return each case with all its methods."""
    by_case: dict[int, list[Walked]] = {}
    for one in drawn:
        by_case.setdefault(one.result.case, []).append(one)
    return [drawn_case(case, ones) for case, ones in by_case.items()]


def drawn_case(case: int, ones: Sequence[Walked]) -> ChengDrawn:
    """Return what is drawn of a case."""
    falls = {one.result.method: (one.falls_s, one.fall_errors_m) for one in ones}
    motions, truth = [thinned(one.estimate) for one in ones], thinned(ones[0].truth)
    return ChengDrawn(f"Case {case}, {ones[0].result.distance_m:.0f} m", motions, truth, falls)


def thinned(track: MotionTrack) -> MotionTrack:
    """Return a track with as many rows as a page needs: 20 a second."""
    return MotionTrack(track.name, *(column[::EVERY] for column in track[1:]))


def drawn_gain(bench: ChengBench) -> GainDrawn:
    """Return what is drawn of K."""
    gains = cheng_gain.GAINS
    tracks = cheng_gain.by_several_gains()
    return GainDrawn(
        convergence=[Line("to a tenth", gains, cheng_gain.convergence_times_s())],
        objective=[line for theory in (cheng_gain.PAPER, cheng_gain.SLOW) for line in objective(theory)],
        tilt=[
            *measured(bench.gains, "tilt_error_deg"),
            *measured(bench.gains, "expected_deg", ("improved",)),
            mark("default", *cheng_gain.default()),
        ],
        ends=measured(bench.gains, "end_error_m"),
        tracks=[one.estimate.course for one in tracks],
        truth=tracks[0].truth.course,
    )


def objective(theory: cheng_gain.GainTheory) -> list[Line]:
    """Return the paper's objective over K, and its minimum by the closed form."""
    gains, name = cheng_gain.GAINS, f"T = {theory.period_s:g} s"
    curve = Line(name, gains, np.asarray(cheng_gain.attitude_error_deg(gains, theory)))
    return [curve, mark(f"K* of {name}", *cheng_gain.minimum(theory))]


def mark(name: str, x: float, y: float) -> Line:
    """Return one point of a figure."""
    return Line(name, np.array([x]), np.array([y]))


def measured(
    points: Sequence[GainPoint], what: str, methods: Sequence[str] = ("improved", "traditional")
) -> list[Line]:
    """Return a figure of the real loop over K, a line for each filter, up to K = 1/s."""
    lines = []
    for method in methods:
        own = [p for p in points if p.method == method and p.gain_per_s <= 1.0]
        name = f"{method}, expected" if what == "expected_deg" else method
        lines.append(Line(name, np.array([p.gain_per_s for p in own]), np.array([getattr(p, what) for p in own])))
    return lines
