"""What `pdr bench --external` has measured, as tables or as JSON."""

import json
from dataclasses import asdict

from pdr_bringup_scripts.benches.suite_tables import console, table
from pdr_core.bench.external_tables import ExternalFigures


def as_json(found: ExternalFigures) -> str:
    """Return every figure as one JSON object."""
    alone = {"rms_m": found.unaided_rms_m, "worst_m": found.unaided_worst_m}
    rows, spreads = [asdict(r) for r in found.rows], [asdict(s) for s in found.consistency]
    return json.dumps({"sources": rows, "without": alone, "consistency": spreads}, indent=2)


def show(found: ExternalFigures) -> None:
    """Print the tables."""
    out = console()
    heads = ("source", "walks", "aligned s", "RMS m", "worst m", "moved m", "let go")
    errors = table("A person whom somebody else follows: errors in their frame", *heads)
    for r in found.rows:
        figures = (f"{r.aligned_s:.0f}", f"{r.rms_m:.2f}", f"{r.worst_m:.2f}", f"{r.moved_m:.2f}", str(r.let_go))
        errors.add_row(r.source, str(r.walks), *figures)
    errors.add_row("none", "", "", f"{found.unaided_rms_m:.2f}", f"{found.unaided_worst_m:.2f}", "", "")
    out.print(errors)
    honest = table("Normalised squares of the place, 2 expected", "covariance", "mean", "inside", "below", "above")
    for s in found.consistency:
        honest.add_row(s.name, f"{s.mean:.2f}", *(f"{share:.0%}" for share in (s.inside, s.below, s.above)))
    out.print(honest)
