"""What `pdr bench --qiu` has measured: as tables, as JSON, as a page with pictures."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from pdr_bringup_scripts.benches.suite_tables import show_titled, write_page
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench.qiu_tables import Cost, Means, means, of
from pdr_core.bench.qiu_walks import METHODS, Measured, QiuResult
from pdr_core.evaluation.qiu_page import DrawnWalk, TitledTable, qiu_page
from pdr_core.evaluation.result import plain

FILES = "qiu.html, qiu.json"


def as_json(walks: Sequence[Measured], costs: Sequence[Cost]) -> str:
    """Return every figure as one JSON object, null for what is unknown."""
    found = {"walks": [figures(w.result) for w in walks], "costs": [asdict(cost) for cost in costs]}
    return json.dumps(plain(found), indent=2, allow_nan=False)


def figures(r: QiuResult) -> dict[str, object]:
    """Return the figures of one walk, flat."""
    errors = ("distance_error_percent", "end_error_percent", "error_per_turn_deg", "height_error_percent")
    return asdict(r) | {name: getattr(r, name) for name in errors}


def show(walks: Sequence[Measured], costs: Sequence[Cost]) -> None:
    """Print the tables."""
    show_titled(tables([w.result for w in walks], costs))


def tables(results: Sequence[QiuResult], costs: Sequence[Cost]) -> list[TitledTable]:
    """Return all tables as text."""
    parts = [rectangles(of(results, "3", m), m) for m in METHODS]
    parts.append(laps(results))
    parts += [subjects(of(results, "5", m), m) for m in METHODS]
    parts += [climbs(of(results, "stairs", m), m) for m in METHODS]
    return [*parts, cost_table(costs)]


def rectangles(results: Sequence[QiuResult], method: str) -> TitledTable:
    """Return Table 3."""
    heads = ("trial", "strides (true)", "distance m", "error %", "heading °", "turns by 90°", "error per turn °")
    turned = [(f"{r.heading_deg:.1f}", str(r.turns), f"{r.error_per_turn_deg:.2f}") for r in results]
    rows = [(*walked(r), *cells) for r, cells in zip(results, turned, strict=True)]
    mean = means(results)
    last = ("mean", "", "", f"{mean.distance_error_percent:.2f}", "", "", f"{mean.error_per_turn_deg:.2f}")
    return TitledTable(f"Table 3, ten right turns in a building: {method}", heads, [*rows, last])


def laps(results: Sequence[QiuResult]) -> TitledTable:
    """Return Table 4: mean and deviation over the laps of each method."""
    heads = ("method", "strides", "off by", "distance m", "error %", "end error m", "end error %", "heading °")
    rows = []
    for method in METHODS:
        found = of(results, "4", method)
        mean = means(found)
        names = ("strides", "distance_m", "end_error_m", "heading_deg")
        strides, distance, end, heading = (spread([getattr(r, name) for r in found]) for name in names)
        off = str(sum(abs(r.strides - r.strides_true) for r in found))
        errors = (f"{mean.distance_error_percent:.2f}", f"{mean.end_error_percent:.2f}")
        rows.append((method, strides, off, distance, errors[0], end, errors[1], heading))
    return TitledTable("Table 4, five laps of 423 m outdoors: mean and deviation", heads, rows)


def subjects(results: Sequence[QiuResult], method: str) -> TitledTable:
    """Return Table 5."""
    heads = ("subject", "strides (true)", "distance m", "error %", "end error m", "end error %")
    rows = [(*walked(r), f"{r.end_error_m:.2f}", f"{r.end_error_percent:.2f}") for r in results]
    mean = means(results)
    last = ("mean", "", "", f"{mean.distance_error_percent:.2f}", "", f"{mean.end_error_percent:.2f}")
    return TitledTable(f"Table 5, one lap or two outdoors: {method}", heads, [*rows, last])


def climbs(results: Sequence[QiuResult], method: str) -> TitledTable:
    """Return the heights of the stair climbs."""
    heads = ("trial", "strides (true)", "height m", "true m", "error %")
    rows = [
        (r.trial, counted(r), f"{r.height_m:.3f}", f"{r.height_true_m:.3f}", f"{r.height_error_percent:+.2f}")
        for r in results
    ]
    return TitledTable(f"Stairs, 20 steps of 16 cm in a building: {method}", heads, rows)


def cost_table(costs: Sequence[Cost]) -> TitledTable:
    """Return what each error of the sensor costs the suite's own chain."""
    heads = ("without", "table", "distance error %", "end error %", "heading error °", "per turn °")
    rows = [(c.without, c.table, *cost_text(c.means)) for c in costs]
    return TitledTable("Means without each error of the sensor: ESKF", heads, rows)


def cost_text(mean: Means) -> tuple[str, ...]:
    """Return the figures of a row."""
    percents = (f"{mean.distance_error_percent:.2f}", f"{mean.end_error_percent:.2f}")
    return (*percents, f"{mean.heading_error_deg:.1f}", f"{mean.error_per_turn_deg:.2f}")


def walked(r: QiuResult) -> tuple[str, ...]:
    """Return which walk it is, its strides and its distance."""
    return r.trial, counted(r), f"{r.distance_m:.2f}", f"{r.distance_error_percent:+.2f}"


def counted(r: QiuResult) -> str:
    """Return the strides found, and how many there were."""
    return f"{r.strides} ({r.strides_true})"


def spread(values: Sequence[float]) -> str:
    """Return mean and standard deviation."""
    return f"{np.mean(values):.2f} ± {np.std(values):.2f}"


def write_files(out: Path, walks: Sequence[Measured], costs: Sequence[Cost]) -> None:
    """Write the page and the figures into a folder that exists; the first walk of each table is drawn."""
    page = qiu_page(tables([w.result for w in walks], costs), drawn(walks), VERSION, commit())
    write_page(out, FILES, page, as_json(walks, costs))


def drawn(walks: Sequence[Measured]) -> list[DrawnWalk]:
    """Return the first walk of each table by every method."""
    first: dict[str, list[Measured]] = {}
    for walk in walks:
        if walk.result.trial == "1":
            first.setdefault(walk.result.table, []).append(walk)
    names = {"stairs": "Stairs"}
    return [DrawnWalk(names.get(t, f"Table {t}"), [w.estimate for w in ws], ws[0].truth) for t, ws in first.items()]
