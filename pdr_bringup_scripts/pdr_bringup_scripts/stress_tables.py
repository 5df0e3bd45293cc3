"""What `pdr bench --stress` has measured, as a table or as JSON."""

import json
import sys
from dataclasses import asdict

from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from pdr_core.bench.stress import StressResult, summary

WIDTH = 120  # where no terminal says its own


def stress_as_json(results: list[StressResult]) -> str:
    """Return the summary and every walk as one JSON object."""
    walks = [
        {"seed": r.drawn.seed, "ate2_percent": r.ate2_percent, "notices": r.notices, "drawn": r.drawn.text}
        for r in results
    ]
    return json.dumps({"summary": [asdict(row) for row in summary(results)], "walks": walks}, indent=2)


def show_stress(results: list[StressResult]) -> None:
    """Print the table, and of every walk that failed what was drawn."""
    console = Console(width=None if sys.stdout.isatty() else WIDTH, highlight=False)
    console.print(stress_table(results))
    for r in results:
        if r.failed:
            console.print(f"seed {r.drawn.seed}: {r.worst_percent:.2f} %: {r.drawn.text}; {', '.join(r.notices)}\n")


def stress_table(results: list[StressResult]) -> Table:
    """Return the figures of all walks and by kind."""
    out = Table(title="Stress: ATE2 in % of the distance", box=SIMPLE, title_justify="left")
    for i, head in enumerate(("walks", "number", "failed", "median", "95th percentile", "worst")):
        out.add_column(head, justify="right" if i else "left", no_wrap=True)
    for row in summary(results):
        figures = (row.median_percent, row.high_percent, row.worst_percent)
        out.add_row(row.kind, str(row.walks), str(row.failed), *(f"{x:.2f}" for x in figures))
    return out
