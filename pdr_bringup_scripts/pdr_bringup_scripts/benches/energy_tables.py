"""What `pdr bench --energy` has measured: as tables, as JSON, as a page with a curve."""

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import NamedTuple

from pdr_bringup_scripts.benches.suite_tables import console, table, write_page
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench.energy_walks import SCHEMES, SIMULATED, EnergyRun, energy_runs, known, means, simulated
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.energy_page import EnergyGroup, energy_page
from pdr_core.evaluation.energy_plots import EnergyPoint
from pdr_core.evaluation.qiu_page import TitledTable
from pdr_core.evaluation.result import plain
from pdr_core.recording import open_recording

FILES = "energy.html, energy.json"
NUMBERS = (31, 33, 36, 39)
FOLDER, FILE = "tile_walks_marg", "SensorConnectData_{}.csv"
NOWHERE = "no real walks: --recordings names no folder"
ABSENT = "no real walks: {} is not there"


class Group(NamedTuple):
    """Walks that are compared, by every scheme."""

    name: str
    runs: Sequence[EnergyRun]


class Found(NamedTuple):
    """What the bench has found, and why there is not more."""

    groups: Sequence[Group]
    left_out: str  # empty: nothing was


def energy(recordings: Path | None, seeds: int, seen: Callable[[str], object] = str) -> Found:
    """Walk the real walks, where they are, and simulated ones with the seeds 1, 2, ..."""
    left_out = missing(recordings)
    real = [] if left_out or recordings is None else [real_walk(recordings, number) for number in NUMBERS]
    drawn = [simulated(where, seed) for where in SIMULATED for seed in range(1, seeds + 1)]
    groups = {"Real walks in a building": real, "Simulated walks": drawn}
    walked = [Group(name, by_all_schemes(walks, seen)) for name, walks in groups.items() if walks]
    return Found(walked, left_out)


def by_all_schemes(walks: Sequence[Walk], seen: Callable[[str], object]) -> list[EnergyRun]:
    """Return walks by every scheme."""
    return [run for walk in walks for run in energy_runs(known(walk), list(SCHEMES), seen)]


def missing(recordings: Path | None) -> str:
    """Return why the real walks cannot be walked; an empty text: they can."""
    if recordings is None:
        return NOWHERE
    paths = [recordings / FOLDER / FILE.format(number) for number in NUMBERS]
    absent = next((path for path in paths if not path.is_file()), None)
    return ABSENT.format(absent) if absent else ""


def real_walk(recordings: Path, number: int) -> Walk:
    """Return a recorded walk."""
    (sensor,) = open_recording(recordings / FOLDER / FILE.format(number)).sensors.values()
    return Walk(str(number), list(sensor.pieces()), sensor.truth)


def as_json(found: Found) -> str:
    """Return every figure as one JSON object."""
    groups = {group.name: [asdict(run) for run in group.runs] for group in found.groups}
    averages = {group.name: [asdict(run) for run in means(group.runs)] for group in found.groups}
    return json.dumps(plain({"runs": groups, "means": averages, "left_out": found.left_out}), indent=2, allow_nan=False)


def show(found: Found) -> None:
    """Print the tables."""
    out = console()
    for one in tables(found):
        printed = table(one.title, *one.heads)
        for cells in one.rows:
            printed.add_row(*cells)
        out.print(printed)
    if found.left_out:
        out.print(found.left_out)


def tables(found: Found) -> list[TitledTable]:
    """Return all tables as text."""
    return [one for group in found.groups for one in (end_table(group), mean_table(group))]


def end_table(group: Group) -> TitledTable:
    """Return each walk, or each seed's mean over walks of one name, by each scheme."""
    names = list(dict.fromkeys(run.walk for run in group.runs))
    rows = [(s, *(cell(group.runs, s, name) for name in names)) for s in dict.fromkeys(r.scheme for r in group.runs)]
    return TitledTable(f"{group.name}: gyro on %, end error %", ("gyro", *names), rows)


def cell(runs: Sequence[EnergyRun], scheme: str, walk: str) -> str:
    """Return share and end error of one walk by one scheme."""
    (one,) = means([run for run in runs if (run.scheme, run.walk) == (scheme, walk)])
    return f"{100.0 * one.gyro_share:.0f}, {one.end_error_percent:.1f}"


def mean_table(group: Group) -> TitledTable:
    """Return the means over the walks."""
    heads = ("gyro", "on %", "end %", "distance %", "largest %", "missed", "sensor saved %")
    rows = []
    for one in means(group.runs):
        largest = max(abs(r.distance_error_percent) for r in group.runs if r.scheme == one.scheme)
        numbers = (100.0 * one.gyro_share, one.end_error_percent, one.distance_error_percent, largest)
        saved = f"{100.0 * one.sensor_saved_share:.0f}"
        rows.append((one.scheme, *(f"{x:.1f}" for x in numbers), str(one.strides_missed), saved))
    return TitledTable(f"{group.name}: means", heads, rows)


def write_files(out: Path, found: Found) -> None:
    """Write the page and the figures into a folder that exists."""
    drawn = [EnergyGroup(g.name, points(g.runs), points(means(g.runs))) for g in found.groups]
    page = energy_page(tables(found), drawn, VERSION, commit())
    write_page(out, FILES, page, as_json(found))


def points(runs: Sequence[EnergyRun]) -> list[EnergyPoint]:
    """Return runs as points of the curve."""
    return [EnergyPoint(run.scheme, run.walk, 100.0 * run.gyro_share, run.end_error_percent) for run in runs]
