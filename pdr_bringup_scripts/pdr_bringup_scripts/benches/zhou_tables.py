"""What `pdr bench --zhou` has measured: as tables, as JSON, as a page with pictures."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from pdr_bringup_scripts.benches.suite_tables import show_titled, write_page
from pdr_bringup_scripts.benches.zhou_cost import StepCost
from pdr_bringup_scripts.benches.zhou_drawings import chapters
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench.zhou_errors import LapResult
from pdr_core.bench.zhou_lengths import LengthError
from pdr_core.bench.zhou_modes import Managed, Transition
from pdr_core.bench.zhou_schemes import SCHEMES
from pdr_core.bench.zhou_tables import TESTER, Drawn, Results, mean, of
from pdr_core.bench.zhou_testers import TABLE_4_DEG, TABLE_6_HZ, Found
from pdr_core.bench.zhou_walks import RATES_HZ, WALKS
from pdr_core.evaluation.qiu_page import TitledTable
from pdr_core.evaluation.result import plain
from pdr_core.evaluation.zhou_page import zhou_page

FILES = "zhou.html, zhou.json"
PAPER_OPERATIONS = {"ZUPT-KF": "1.0377e6", "ours": "6"}  # Zhou Table 8, at 200 and 50 Hz


def as_json(results: Results, costs: Sequence[StepCost]) -> str:
    """Return every figure as one JSON object; what was never found is null."""
    found = asdict(results) | {"costs": [asdict(cost) for cost in costs]}
    return json.dumps(plain(found), indent=2, allow_nan=False)


def show(results: Results, costs: Sequence[StepCost]) -> None:
    """Print the tables."""
    show_titled(tables(results, costs))


def tables(results: Results, costs: Sequence[StepCost]) -> list[TitledTable]:
    """Return all tables as text."""
    return [
        *(table_5(of(results.laps, gait=gait), gait) for gait in WALKS),
        table_4(results.found),
        table_6(results.tester_laps),
        table_8(costs),
        transition_table(results.transitions),
        managed_table(results.managed),
        length_table(results.lengths),
    ]


def table_5(laps: Sequence[LapResult], gait: str) -> TitledTable:
    """Return Tables 5 and 7 of one gait."""
    seeds = len({lap.seed for lap in laps})
    heads = ("scheme", "Hz", "corners m", "RMSE m", "misclosure m", "heading °", "distance %", "distance m", "strides")
    rows = [lap_row(mean(of(laps, scheme=s, rate_hz=r)), miscounted(of(laps, scheme=s, rate_hz=r)))
            for s in SCHEMES for r in RATES_HZ]  # fmt: skip
    title = f"Zhou Tables 5 and 7, {gait}: second lap of tester {TESTER.upper()}, means of {seeds} walks"
    return TitledTable(title, heads, rows)


def lap_row(lap: LapResult, off: int) -> tuple[str, ...]:
    """Return the figures of a scheme at a rate; the strides that were found too often, or not at all, of all walks."""
    metres = (f"{x:.2f}" for x in (lap.corner_error_m, lap.rmse_m, lap.misclosure_m))
    distance = (f"{lap.distance_error_percent:.2f}", f"{lap.distance_error_m:.2f}")
    return lap.scheme, str(lap.rate_hz), *metres, f"{lap.heading_error_deg:.1f}", *distance, f"{off:+d}"


def miscounted(laps: Sequence[LapResult]) -> int:
    """Return how many strides were found too many, or, negative, too few."""
    return sum(lap.strides - lap.strides_true for lap in laps)


def table_4(found: Sequence[Found]) -> TitledTable:
    """Return Table 4: the deviations that were found."""
    heads = ("tester", "true °", "found °", "from .. to °", "largest error °", "by velocity °")
    rows = []
    for name, true_deg in TABLE_4_DEG.items():
        learnt = np.array([f.learnt_deg for f in found if f.tester == name])
        velocity = float(np.mean([f.by_velocity_deg for f in found if f.tester == name]))
        span = f"{learnt.min():.2f} .. {learnt.max():.2f}"
        rows.append((name.upper(), f"{true_deg:.1f}", f"{learnt.mean():.2f}", span,
                     f"{np.abs(learnt - true_deg).max():.2f}", f"{velocity:.2f}"))  # fmt: skip
    return TitledTable("Zhou Table 4: heading deviations, learnt on the first lap", heads, rows)


def table_6(laps: Sequence[LapResult]) -> TitledTable:
    """Return Table 6: what the deviation is worth."""
    heads = ("tester", "corners, PDR m", "corners, ours m", "RMSE, PDR m", "RMSE, ours m")
    rows = []
    for name in TABLE_4_DEG:
        pdr, ours = (mean(of(laps, tester=name, scheme=scheme)) for scheme in ("PDR", "ours"))
        figures = (pdr.corner_error_m, ours.corner_error_m, pdr.rmse_m, ours.rmse_m)
        rows.append((name.upper(), *(f"{x:.2f}" for x in figures)))
    return TitledTable(f"Zhou Table 6: without and with the heading deviation, {TABLE_6_HZ} Hz", heads, rows)


def table_8(costs: Sequence[StepCost]) -> TitledTable:
    """Return Tables 8 and 9: what a step costs."""
    heads = ("method", "Hz", "operations", "paper", "interpreted ms", "of ZUPT-KF", "as it runs ms")
    filters = {c.rate_hz: c for c in costs if c.method == "ZUPT-KF"}
    rows = [
        (c.method, str(c.rate_hz), f"{c.operations:.3g}", paper(c), f"{c.interpreted_ms:.1f}",
         f"{c.interpreted_ms / filters[c.rate_hz].interpreted_ms:.2f}", f"{c.compiled_ms:.2f}")
        for c in costs
    ]  # fmt: skip
    return TitledTable("Zhou Tables 8 and 9: what a walked step costs", heads, rows)


def paper(c: StepCost) -> str:
    """Return what Zhou's Table 8 says of it."""
    return PAPER_OPERATIONS[c.method] if (c.method, c.rate_hz) in (("ZUPT-KF", 200), ("ours", 50)) else ""


def transition_table(transitions: Sequence[Transition]) -> TitledTable:
    """Return how soon changes of behaviour were found."""
    heads = ("from", "to", "changes", "found", "strides, mean", "most", "seconds, mean", "most")
    rows = []
    for before, after in dict.fromkeys((t.before, t.after) for t in transitions):
        these = [t for t in transitions if (t.before, t.after) == (before, after)]
        strides, seconds = np.array([t.strides for t in these]), np.array([t.delay_s for t in these])
        found = int(np.isfinite(strides + seconds).sum())
        rows.append((before, after, str(len(these)), str(found), f"{strides.mean():.2f}", f"{strides.max():.2f}",
                     f"{seconds.mean():.2f}", f"{seconds.max():.2f}"))  # fmt: skip
    return TitledTable("Zhou figure 15: how soon it is known what the foot does", heads, rows)


def managed_table(walks: Sequence[Managed]) -> TitledTable:
    """Return the walks with the manager in charge."""
    heads = ("walk", "walks", "s", "m", "gyro on %", "most %", "charge saved %", "end error m", "strides")
    rows = []
    for name in dict.fromkeys(w.walk for w in walks):
        these = [w for w in walks if w.walk == name]
        names = ("duration_s", "distance_m", "gyro_on_percent", "sensor_saved_percent", "end_error_m")
        seconds, metres, on, saved, end = (float(np.mean([getattr(w, n) for w in these])) for n in names)
        most, off = max(w.gyro_on_percent for w in these), sum(w.strides - w.strides_true for w in these)
        rows.append((name, str(len(these)), f"{seconds:.0f}", f"{metres:.0f}", f"{on:.1f}", f"{most:.1f}",
                     f"{saved:.1f}", f"{end:.2f}", f"{off:+d}"))  # fmt: skip
    return TitledTable("The manager in charge, outdoors: calibration included", heads, rows)


def length_table(errors: Sequence[LengthError]) -> TitledTable:
    """Return how far the step length models are off."""
    heads = ("model", "rms cm", "after changes cm", "distance %", "largest distance %")
    rows = []
    for name in dict.fromkeys(e.model for e in errors):
        these = [e for e in errors if e.model == name]
        rms, near = (float(np.mean([getattr(e, n) for e in these])) for n in ("rms_cm", "near_changes_rms_cm"))
        distances = np.array([e.distance_percent for e in these])
        rows.append((name, f"{rms:.1f}", f"{near:.1f}", f"{np.abs(distances).mean():.2f}",
                     f"{np.abs(distances).max():.2f}"))  # fmt: skip
    title = "Zhou figure 16: step lengths over walking, running, walking; the classical models calibrated offline"
    return TitledTable(title, heads, rows)


def write_files(out: Path, results: Results, costs: Sequence[StepCost], drawn: Drawn) -> None:
    """Write the page and the figures into a folder that exists."""
    page = zhou_page(tables(results, costs), chapters(drawn), VERSION, commit())
    write_page(out, FILES, page, as_json(results, costs))
