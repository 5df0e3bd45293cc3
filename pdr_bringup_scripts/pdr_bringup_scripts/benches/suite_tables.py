"""What `pdr bench` has measured, as tables or as JSON."""

import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from pdr_core.bench.consistency import Consistency
from pdr_core.bench.mechanisation import MechanisationError
from pdr_core.bench.table_1 import Table1Result
from pdr_core.evaluation.qiu_page import TitledTable

WIDTH = 120


def as_json(errors: list[MechanisationError], table_1: list[Table1Result], found: list[Consistency]) -> str:
    """Return everything as one JSON object."""
    parts = {
        "mechanisation": [asdict(row) for row in errors],
        "table_1": [asdict(row) for row in table_1],
        "consistency": [asdict(row) for row in found],
    }
    return json.dumps(parts, indent=2)


def show(errors: list[MechanisationError], table_1: list[Table1Result], found: list[Consistency]) -> None:
    """Print the tables: with colours on a terminal, as plain text elsewhere."""
    out = console()
    for one in (mechanisation_table(errors), table_1_table(table_1), *map(consistency_table, found)):
        out.print(one)


def write_page(out: Path, files: str, page: str, figures: str) -> None:
    """Write a page and its figures, a JSON object, into a folder that exists; `files`: both names."""
    for name, text in zip(files.split(", "), (page, figures + "\n"), strict=True):
        (out / name).write_text(text, encoding="utf-8")


def console(width: int = WIDTH) -> Console:
    """Return where tables are printed; `width` where no terminal says its own."""
    return Console(width=None if sys.stdout.isatty() else width, highlight=False)


def table(title: str, *heads: str, names: int = 1) -> Table:
    """Return an empty table, names in the first columns, numbers to the right."""
    empty = Table(title=title, box=SIMPLE, title_justify="left")
    for i, head in enumerate(heads):
        if i < names:
            empty.add_column(head, no_wrap=True)
        else:
            empty.add_column(head, justify="right", no_wrap=True, min_width=len(head))
    return empty


def show_titled(tables: Sequence[TitledTable], names: int = 1) -> None:
    """Print tables of text."""
    out = console()
    for one in tables:
        printed = table(one.title, *one.heads, names=names)
        for row in one.rows:
            printed.add_row(*row)
        out.print(printed)


def mechanisation_table(errors: list[MechanisationError]) -> Table:
    """Return the error of inertia alone, by rate."""
    out = table("Mechanisation alone, ideal point samples", "motion", "Hz", "walked s", "m", "mm", "mm/s", "mrad")
    for e in errors:
        numbers = (e.rate_hz, e.walked_s, e.distance_m)
        largest = (1e3 * e.position_m, 1e3 * e.velocity_mps, 1e3 * e.attitude_rad)
        out.add_row(e.motion, *(f"{x:.0f}" for x in numbers), *(f"{x:.3g}" for x in largest))
    return out


def table_1_table(results: list[Table1Result]) -> Table:
    """Return the walks with the sensors of Gui's Table 1."""
    title = "Gui Table 1: his walk, the whole pipeline"
    out = table(title, "sensor", "suite told of it", "m", "end error %", "ATE2 m", "strides", "true strides")
    for r in results:
        errors = (f"{r.distance_m:.1f}", f"{r.end_error_percent:.3g}", f"{r.ate2_m:.3g}")
        out.add_row(r.sensor_model, "yes" if r.told else "no", *errors, str(r.strides), str(r.true_strides))
    return out


def consistency_table(c: Consistency) -> Table:
    """Return the normalised squares of one campaign; the shares are those of the stance epochs."""
    end = f"end error: median {c.end_error_median_percent:.2f} %, 95th percentile {c.end_error_95_percent:.2f} %"
    title = f"Consistency, {c.name}: {c.runs} walks of {c.distance_m:.1f} m; {end}; stance found {c.stance_found:.0%}"
    out = table(title, "", "freedom", "mean", "within 95 % bounds", "below: too careful", "above: too sure")
    for s in c.spreads:
        out.add_row(s.name, str(s.freedom), f"{s.mean:.2f}", *(f"{x:.1%}" for x in (s.inside, s.below, s.above)))
    return out
