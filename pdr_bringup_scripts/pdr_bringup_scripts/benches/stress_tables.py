"""What `pdr bench --stress` has measured, as a table or as JSON."""

import json
from dataclasses import asdict

from rich.table import Table

from pdr_bringup_scripts.benches.suite_tables import console, table
from pdr_core.bench.stress import StressResult, summary


def as_json(results: list[StressResult]) -> str:
    """Return the summary and every walk as one JSON object."""
    walks = [
        {"seed": r.drawn.seed, "ate2_percent": r.ate2_percent, "notices": r.notices, "drawn": r.drawn.text}
        for r in results
    ]
    return json.dumps({"summary": [asdict(row) for row in summary(results)], "walks": walks}, indent=2)


def show(results: list[StressResult]) -> None:
    """Print the table, and of every walk that failed what was drawn."""
    out = console()
    out.print(stress_table(results))
    for r in results:
        if r.failed:
            out.print(f"seed {r.drawn.seed}: {r.worst_percent:.2f} %: {r.drawn.text}; {', '.join(r.notices)}\n")


def stress_table(results: list[StressResult]) -> Table:
    """Return the figures of all walks and by kind."""
    heads = ("walks", "number", "failed", "median", "95th percentile", "worst")
    out = table("Stress: ATE2 in % of the distance", *heads)
    for row in summary(results):
        figures = (row.median_percent, row.high_percent, row.worst_percent)
        out.add_row(row.kind, str(row.walks), str(row.failed), *(f"{x:.2f}" for x in figures))
    return out
