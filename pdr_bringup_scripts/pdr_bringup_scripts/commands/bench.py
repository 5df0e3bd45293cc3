"""`pdr bench`: the suite against its simulator."""

from pathlib import Path

import typer

from pdr_bringup_scripts.benches.jobs import Job, default_seeds, run, with_page
from pdr_bringup_scripts.options import finite


def bench(
    stress: bool = typer.Option(False, "--stress", help="instead: seeded walks of every gait with every trouble"),
    qiu: bool = typer.Option(False, "--qiu", help="instead: Qiu's Tables 3, 4 and 5 and his stairs, with his sensor"),
    gui: bool = typer.Option(False, "--gui", help="instead: Gui's Table 3, with his sensor: every part of his method"),
    dual: bool = typer.Option(False, "--dual", help="instead: what one foot tells the other's heading"),
    zhou: bool = typer.Option(False, "--zhou", help="instead: Zhou's section 5, the second lap without the gyro"),
    energy: bool = typer.Option(False, "--energy", help="instead: how far off a walk ends, by when its gyro is on"),
    cheng: bool = typer.Option(False, "--cheng", help="instead: Cheng's Table 2, a card on the chest, and K"),
    external: bool = typer.Option(False, "--external", help="instead: a walk that somebody else's fixes aid"),
    seeds: int = typer.Option(None, min=1, help=f"walks, of each campaign; default: {default_seeds()}"),
    length: float = typer.Option(None, min=1.2, callback=finite, help="of the consistency walks and of --external [m]"),
    recordings: Path = typer.Option(
        None, envvar="PDR_RECORDINGS", help="with --energy: folder of the real walks; without it, they are left out"
    ),
    out: Path = typer.Option(None, "--out", "-o", help=f"folder for a page and JSON, of {with_page()}"),
    json: bool = typer.Option(False, "--json", help="print everything as one JSON object"),
) -> None:
    """Measure mechanisation, Gui's Table 1 and the filter's consistency on simulated walks, or something else instead.

    Example: `pdr bench`, or quickly `pdr bench --seeds 10 --length 24`, or `pdr bench --stress`
    or `--external`, or with `--out folder` one of `--qiu`, `--gui`, `--dual`, `--zhou`, `--energy` and `--cheng`
    """
    asked = {"--stress": stress, "--qiu": qiu, "--gui": gui, "--dual": dual, "--zhou": zhou, "--energy": energy}
    run(asked | {"--cheng": cheng, "--external": external}, Job(seeds, length, out, json, recordings))
