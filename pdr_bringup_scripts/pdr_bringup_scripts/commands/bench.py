"""`pdr bench`: the suite against its simulator."""

from pathlib import Path

import typer

from pdr_bringup_scripts.options import finite


def bench(
    stress: bool = typer.Option(False, "--stress", help="instead: seeded walks of every gait with every trouble"),
    qiu: bool = typer.Option(False, "--qiu", help="instead: Qiu's Tables 3, 4 and 5 and his stairs, with his sensor"),
    seeds: int = typer.Option(None, min=1, help="walks; default: 100 of each consistency campaign, 500 of --stress"),
    length: float = typer.Option(
        None, min=1.2, callback=finite, help="length of the consistency walks [m]; default: 100"
    ),
    out: Path = typer.Option(None, "--out", "-o", help="with --qiu: folder for a page with pictures, and JSON"),
    json: bool = typer.Option(False, "--json", help="print everything as one JSON object"),
) -> None:
    """Measure mechanisation, Gui's Table 1 and the filter's consistency on simulated walks.

    Example: `pdr bench`, or quickly `pdr bench --seeds 10 --length 24`, or `pdr bench --stress`,
    or `pdr bench --qiu --out qiu`
    """
    from pdr_bringup_scripts.problems import Problem

    if (stress or qiu) and length:
        raise Problem("the walks of --stress and --qiu have lengths of their own: leave out --length")
    if qiu and (stress or seeds):
        raise Problem("the walks of --qiu are those of the paper: leave out --stress and --seeds")
    if out and not qiu:
        raise Problem("only the walks of --qiu have a page: leave out --out")
    if qiu:
        run_qiu(out, json)
    elif stress:
        run_stress(seeds or 500, json)
    else:
        run_figures(seeds or 100, length or 100.0, json)


def run_stress(seeds: int, json: bool) -> None:
    """Walk through every trouble and print what came of it."""
    from pdr_bringup_scripts.stress_tables import show_stress, stress_as_json
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.bench.stress import stress

    with Terminal().progress(f"Stress, walks of {seeds}") as tell:
        results = stress(range(seeds), tell)
    if json:
        print(stress_as_json(results))
    else:
        show_stress(results)


def run_qiu(out: Path | None, json: bool) -> None:
    """Walk Qiu's walks, print what came of it, and draw it."""
    from pdr_bringup_scripts.book import make_folder
    from pdr_bringup_scripts.problems import Problem
    from pdr_bringup_scripts.qiu_tables import FILES, as_json, show, write_files
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.bench.orientations import CannotOrient
    from pdr_core.bench.qiu_tables import costs, qiu_tables

    if out:
        make_folder(out)
    terminal = Terminal()
    with terminal.progress("Qiu's walks") as tell:
        try:
            walks = qiu_tables(tell)
        except CannotOrient as why:
            raise Problem(str(why)) from why
    with terminal.progress("What each error of the sensor costs") as tell:
        cost = costs(tell)
    if json:
        print(as_json(walks, cost))
    else:
        show(walks, cost)
    if out:
        write_files(out, walks, cost)
        terminal.say(f"Written to {out}: {FILES}")


def run_figures(seeds: int, length: float, json: bool) -> None:
    """Measure and print mechanisation, Table 1 and consistency."""
    from pdr_bringup_scripts.bench_tables import as_json, show
    from pdr_bringup_scripts.terminal import Terminal
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
        with terminal.progress(f"Consistency, {campaign.name}, walks of {seeds}") as tell:
            found.append(consistency(campaign, seeds, length, tell))
    if json:
        print(as_json(errors, table_1, found))
    else:
        show(errors, table_1, found)
