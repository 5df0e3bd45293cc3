"""What `pdr bench --gui` has measured: as tables, as JSON, as a page with pictures."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from pdr_bringup_scripts.benches.suite_tables import show_titled, write_page
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench.gui_tables import GuiRow, rows
from pdr_core.bench.gui_variants import TABLE_3, VARIANTS
from pdr_core.bench.gui_walks import GuiResult, Measured
from pdr_core.evaluation.gui_page import GuiDrawn, gui_page
from pdr_core.evaluation.qiu_page import TitledTable
from pdr_core.evaluation.result import plain

FILES = "gui.html, gui.json"


def as_json(results: Sequence[GuiResult]) -> str:
    """Return every figure as one JSON object."""
    walks = [asdict(r) | {"end_error_m": r.end_error_m, "end_error_percent": r.end_error_percent} for r in results]
    return json.dumps(plain({"table_3": [asdict(row) for row in rows(results)], "walks": walks}), indent=2)


def show(results: Sequence[GuiResult]) -> None:
    """Print the tables."""
    show_titled(tables(results))


def tables(results: Sequence[GuiResult]) -> list[TitledTable]:
    """Return Table 3, and a table of each walk, as text."""
    found = rows(results)
    walks = list(dict.fromkeys(row.walk for row in found))
    return [table_3(found, walks), *(walk_table([row for row in found if row.walk == walk]) for walk in walks)]


def table_3(found: Sequence[GuiRow], walks: Sequence[str]) -> TitledTable:
    """Return Gui's Table 3: the mean positioning error of every variant."""
    percents = {(row.walk, row.variant): f"{row.end_error_percent:.2f}" for row in found}
    lines = [(variant, *(percents[walk, variant] for walk in walks)) for variant in VARIANTS]
    title = f"Gui Table 3: positioning error %, mean of {found[0].seeds} walks each"
    return TitledTable(title, ("algorithm", *walks), lines)


def walk_table(found: Sequence[GuiRow]) -> TitledTable:
    """Return what the variants make of a walk."""
    heads = ("algorithm", "end of walk 1 m", "end error m", "%", "largest %", "of the floor", "ATE2 m", "yaw at end °")
    first = found[0]
    return TitledTable(f"{first.walk} ({first.distance_m:.1f} m)", heads, [walk_row(row) for row in found])


def walk_row(row: GuiRow) -> tuple[str, ...]:
    """Return the figures of a variant."""
    end = f"({row.end_x_m:.2f}, {row.end_y_m:.2f})"
    percents = (f"{row.end_error_percent:.2f}", f"{row.largest_percent:.2f}", f"{row.over_floor:.2f}")
    return row.variant, end, f"{row.end_error_m:.2f}", *percents, f"{row.ate2_m:.2f}", f"{row.yaw_error_deg:.1f}"


def write_files(out: Path, results: Sequence[GuiResult], drawn: Sequence[Measured]) -> None:
    """Write the page and the figures into a folder that exists."""
    page = gui_page(tables(results), walks(drawn), VERSION, commit())
    write_page(out, FILES, page, as_json(results))


def walks(drawn: Sequence[Measured]) -> list[GuiDrawn]:
    """Return each walk with all its variants."""
    by_walk: dict[str, list[Measured]] = {}
    for one in drawn:
        by_walk.setdefault(one.result.walk, []).append(one)
    return [drawn_walk(name, ones) for name, ones in by_walk.items()]


def drawn_walk(name: str, ones: Sequence[Measured]) -> GuiDrawn:
    """Return what is drawn of a walk."""
    courses = [one.estimate.course for one in ones]
    motions = [one.estimate for one in ones if one.result.variant in TABLE_3]
    return GuiDrawn(name, courses, motions, ones[0].truth)
