"""`pdr compare`: every stance detector on the same recordings."""

from pathlib import Path

import typer


def compare(
    recordings: list[Path] = typer.Argument(help="rosbag2 directories, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    detectors: str = typer.Option("all", help="all, or some of them with commas: adaptive,glrt,mbgtd"),
    time_gates: str = typer.Option("none", help="all, or some of none,gait_phases,kmeans,kmeans_offline"),
    out: Path = typer.Option(None, "--out", "-o", help="folder for a page with pictures, CSV and JSON"),
    json: bool = typer.Option(False, "--json", help="print everything as one JSON object"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    columns: Path = typer.Option(None, help="column map of text recordings, see the guide on recordings"),
) -> None:
    """Run every stance detector over recordings and say how far off each track comes out.

    With `--out` or `--json` also: steps found by windows of every length, and what each part of the method is worth
    where the truth is known.

    Example: `pdr compare --detectors all *.mcap --out compared` and then open `compared/compare.html`
    """
    from pdr_bringup_scripts.book import make_folder
    from pdr_bringup_scripts.compare_tables import show_comparison
    from pdr_bringup_scripts.comparing import Job, chosen_detectors, chosen_gates, compared, tell, write_files
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.evaluation.detector_tables import as_json
    from pdr_core.params import Params
    from pdr_core.params_file import load_params

    chosen, terminal = load_params(params) if params else Params(), Terminal()
    job = Job(chosen, chosen_detectors(detectors), chosen_gates(time_gates), bool(out or json), columns)
    if out:
        make_folder(out)
    done = compared(recordings, job, terminal)
    if done.studies and json:
        print(as_json(done.studies))
    elif done.studies:
        show_comparison(done.studies)
    if done.studies and out:
        write_files(out, done.studies, terminal)
    tell(done, terminal)
