"""`pdr bench`: the suite against its simulator."""

import typer


def bench(
    seeds: int = typer.Option(100, min=1, help="walks of each consistency campaign"),
    length: float = typer.Option(100.0, min=1.2, help="length of these walks [m]"),
    json: bool = typer.Option(False, "--json", help="print everything as one JSON object"),
) -> None:
    """Measure mechanisation, Gui's Table 1 and the filter's consistency on simulated walks.

    Example: `pdr bench`, or quickly `pdr bench --seeds 10 --length 24`
    """
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
