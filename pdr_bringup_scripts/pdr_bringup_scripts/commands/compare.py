"""`pdr compare`: every stance detector, or every method of orientation, on the same recordings."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params


def compare(
    recordings: list[Path] = typer.Argument(help="rosbag2 directories, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    detectors: str = typer.Option("all", help="all, or some of them with commas: adaptive,glrt,mbgtd"),
    time_gates: str = typer.Option("none", help="all, or some of none,gait_phases,kmeans,kmeans_offline"),
    orientations: str = typer.Option(
        None,
        help="instead: all, or some of error_state,quaternion_ekf,gradient_descent,complementary,factored_quaternion",
    ),
    out: Path = typer.Option(None, "--out", "-o", help="folder for a page with pictures, CSV and JSON"),
    json: bool = typer.Option(False, "--json", help="print everything as one JSON object"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    columns: Path = typer.Option(None, help="column map of text recordings, see the guide on recordings"),
) -> None:
    """Run every stance detector over recordings and say how far off each track comes out.

    With `--out` or `--json` also: steps found by windows of every length, and what each part of the method is worth
    where the truth is known. With `--orientations` the methods of orientation are compared instead, and strides and
    foot pitch with motion capture where heel and toe are known.

    Example: `pdr compare --detectors all *.mcap --out compared` and then open `compared/compare.html`
    """
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params
    from pdr_core.params_file import load_params

    chosen, terminal = load_params(params) if params else Params(), Terminal()
    if orientations:
        compare_orientations(recordings, orientations, chosen, columns, out, json, terminal)
    else:
        compare_detectors(recordings, (detectors, time_gates), chosen, columns, out, json, terminal)


def compare_detectors(
    recordings: list[Path],
    names: tuple[str, str],
    params: "Params",
    columns: Path | None,
    out: Path | None,
    json: bool,
    terminal: "Terminal",
) -> None:
    """Compare stance detectors and their time gates."""
    from pdr_bringup_scripts.book import make_folder
    from pdr_bringup_scripts.compare_tables import show_comparison
    from pdr_bringup_scripts.comparing import DetectorJob, chosen_detectors, chosen_gates, compared, tell, write_files
    from pdr_core.evaluation.detector_tables import as_json

    job = DetectorJob(params, chosen_detectors(names[0]), chosen_gates(names[1]), bool(out or json))
    if out:
        make_folder(out)
    done = compared(recordings, columns, job, terminal)
    if done.studies and json:
        print(as_json(done.studies))
    elif done.studies:
        show_comparison(done.studies)
    if done.studies and out:
        write_files(out, done.studies, terminal)
    tell(done, terminal)


def compare_orientations(
    recordings: list[Path],
    names: str,
    params: "Params",
    columns: Path | None,
    out: Path | None,
    json: bool,
    terminal: "Terminal",
) -> None:
    """Compare methods of orientation."""
    from pdr_bringup_scripts.book import make_folder
    from pdr_bringup_scripts.comparing import compared, tell
    from pdr_bringup_scripts.orientation_comparing import OrientationJob, chosen_methods, show, write_page
    from pdr_core.evaluation.orientation_tables import as_json

    job = OrientationJob(params, chosen_methods(names))
    if out:
        make_folder(out)
    done = compared(recordings, columns, job, terminal)
    if done.studies and json:
        print(as_json(done.studies))
    elif done.studies:
        show(done.studies, terminal)
    if done.studies and out:
        write_page(out, done.studies, terminal)
    tell(done, terminal)
