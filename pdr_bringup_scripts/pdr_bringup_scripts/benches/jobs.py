"""The benches that `pdr bench` chooses among: what each walks, prints and draws.

A bench has a module of tables. Its `as_json` and `show` take what was measured; `write_files` takes it too, and behind
it what is only drawn.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.terminal import Terminal


@dataclass(frozen=True)
class Job:
    """What is asked of a bench; without number or length of the walks, those of the bench hold."""

    seeds: int | None
    length_m: float | None
    out: Path | None
    json: bool
    recordings: Path | None


class Walks(NamedTuple):
    """What a bench walks."""

    seeds: int
    length_m: float
    recordings: Path | None


class Shown(NamedTuple):
    """What a bench has found, and the module that shows it."""

    tables: ModuleType
    measured: tuple[Any, ...]
    drawn: tuple[Any, ...] = ()


class Bench(NamedTuple):
    """One of them."""

    measure: Callable[["Walks"], Shown]
    seeds: int | None  # by default; None: the walks are those of a paper
    length_m: float | None = None  # by default; None: the walks have lengths of their own
    has_page: bool = True


def run(asked: Mapping[str, bool], job: Job) -> None:
    """Run the bench whose option was given, or the one without an option; Problem if options do not go together."""
    from pdr_bringup_scripts.run.track_book import make_folder

    bench = chosen([name for name, wanted in asked.items() if wanted], job)
    if job.out:
        make_folder(job.out)
    walks = Walks(job.seeds or bench.seeds or 0, job.length_m or bench.length_m or 0.0, job.recordings)
    found = bench.measure(walks)
    if job.json:
        print(found.tables.as_json(*found.measured))
    else:
        found.tables.show(*found.measured)
    if job.out:
        found.tables.write_files(job.out, *found.measured, *found.drawn)
        Terminal().say(f"Written to {job.out}: {found.tables.FILES}")


def chosen(names: Sequence[str], job: Job) -> Bench:
    """Return the bench that is asked for; Problem if options do not go together."""
    if len(names) > 1:
        own = listed([name for name in BENCHES if name])
        raise Problem(f"{own} are benches of their own: choose one")
    bench = BENCHES["".join(names)]
    if job.length_m and not bench.length_m:
        raise Problem(f"the walks of {names[0]} have lengths of their own: leave out --length")
    if job.seeds and not bench.seeds:
        raise Problem(f"the walks of {names[0]} are those of the paper: leave out --seeds")
    if job.out and not bench.has_page:
        raise Problem(f"only the walks of {with_page()} have a page: leave out --out")
    return bench


def listed(names: Sequence[str]) -> str:
    """Return names as one says them."""
    *most, last = names
    return f"{', '.join(most)} and {last}"


def with_page() -> str:
    """Return the options of the benches that have a page."""
    return listed([name for name, bench in BENCHES.items() if bench.has_page])


def default_seeds() -> str:
    """Return how many walks each bench makes by default, the one without an option first."""
    return ", ".join(f"{name} {bench.seeds}".strip() for name, bench in BENCHES.items() if bench.seeds)


def figures(walks: Walks) -> Shown:
    """Measure mechanisation, Table 1 and consistency."""
    from pdr_bringup_scripts.benches import suite_tables as bench_tables
    from pdr_core.bench.consistency import CAMPAIGNS, consistency
    from pdr_core.bench.mechanisation import mechanisation_errors
    from pdr_core.bench.table_1 import table_1_results

    terminal = Terminal()
    with terminal.progress("Mechanisation"):
        errors = mechanisation_errors()
    with terminal.progress("Table 1"):
        table_1 = table_1_results()
    found = []
    for campaign in CAMPAIGNS:
        with terminal.progress(f"Consistency, {campaign.name}, walks of {walks.seeds}") as tell:
            found.append(consistency(campaign, walks.seeds, walks.length_m, tell))
    return Shown(bench_tables, (errors, table_1, found))


def stress(walks: Walks) -> Shown:
    """Walk through every trouble."""
    from pdr_bringup_scripts.benches import stress_tables
    from pdr_core.bench.stress import stress as stressed

    with Terminal().progress(f"Stress, walks of {walks.seeds}") as tell:
        return Shown(stress_tables, (stressed(range(walks.seeds), tell),))


def qiu(_: Walks) -> Shown:
    """Walk Qiu's walks."""
    from pdr_bringup_scripts.benches import qiu_tables
    from pdr_core.bench.orientations import CannotOrient
    from pdr_core.bench.qiu_tables import costs
    from pdr_core.bench.qiu_tables import qiu_tables as qiu_walks

    terminal = Terminal()
    with terminal.progress("Qiu's walks") as tell:
        try:
            found = qiu_walks(tell)
        except CannotOrient as why:
            raise Problem(str(why)) from why
    with terminal.progress("What each error of the sensor costs") as tell:
        return Shown(qiu_tables, (found, costs(tell)))


def gui(walks: Walks) -> Shown:
    """Walk Gui's walks by every part of Gui's method; the first ones are drawn."""
    from pdr_bringup_scripts.benches import gui_tables
    from pdr_core.bench.gui_tables import gui_walks

    with Terminal().progress("Gui's walks") as tell:
        results, drawn = gui_walks(walks.seeds, tell)
    return Shown(gui_tables, (results,), (drawn,))


def dual(walks: Walks) -> Shown:
    """Walk with both feet."""
    from pdr_bringup_scripts.benches import dual_tables
    from pdr_core.bench.dual_tables import dual_walks

    with Terminal().progress("Both feet") as tell:
        return Shown(dual_tables, (dual_walks(walks.seeds, tell),))


def zhou(walks: Walks) -> Shown:
    """Walk Zhou's walks; the first ones are drawn."""
    from pdr_bringup_scripts.benches import zhou_tables
    from pdr_bringup_scripts.benches.zhou_cost import cost
    from pdr_core.bench.zhou_tables import zhou_walks

    terminal = Terminal()
    with terminal.progress("Zhou's walks") as tell:
        results, drawn = zhou_walks(walks.seeds, tell)
    with terminal.progress("What a step costs") as tell:
        return Shown(zhou_tables, (results, cost(tell)), (drawn,))


def energy(walks: Walks) -> Shown:
    """Walk with the gyro on and off by every scheme."""
    from pdr_bringup_scripts.benches import energy_tables

    with Terminal().progress("Energy") as tell:
        return Shown(energy_tables, (energy_tables.energy(walks.recordings, walks.seeds, tell),))


def cheng(walks: Walks) -> Shown:
    """Walk Cheng's walks with a card on the chest; the first ones are drawn."""
    from pdr_bringup_scripts.benches import cheng_tables
    from pdr_core.bench.cheng_tables import cheng as chengs_walks

    with Terminal().progress("Cheng's walks") as tell:
        return Shown(cheng_tables, (chengs_walks(walks.seeds, tell),))


def external(walks: Walks) -> Shown:
    """Walk beside a source of positions."""
    from pdr_bringup_scripts.benches import external_tables
    from pdr_core.bench.external_tables import external_walks

    with Terminal().progress("Beside somebody else") as tell:
        return Shown(external_tables, (external_walks(walks.seeds, walks.length_m, tell),))


BENCHES = {
    "": Bench(figures, seeds=100, length_m=100.0, has_page=False),
    "--stress": Bench(stress, seeds=500, has_page=False),
    "--qiu": Bench(qiu, seeds=None),
    "--gui": Bench(gui, seeds=50),
    "--dual": Bench(dual, seeds=20),
    "--zhou": Bench(zhou, seeds=20),
    "--energy": Bench(energy, seeds=2),
    "--cheng": Bench(cheng, seeds=20),
    "--external": Bench(external, seeds=10, length_m=600.0, has_page=False),
}
