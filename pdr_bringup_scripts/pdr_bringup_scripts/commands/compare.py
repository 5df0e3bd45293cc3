"""`pdr compare`: every stance detector, method of orientation or heading constraint, on the same recordings."""

from pathlib import Path
from typing import Any

import typer

METHODS = "instead: all, or some of error_state,quaternion_ekf,gradient_descent,complementary,factored_quaternion"


def compare(
    recordings: list[Path] = typer.Argument(help="rosbag2 directories, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    detectors: str = typer.Option("all", help="all, or some of them with commas: adaptive,glrt,mbgtd"),
    time_gates: str = typer.Option("none", help="all, or some of none,gait_phases,kmeans,kmeans_offline"),
    orientations: str = typer.Option(None, help=METHODS),
    headings: str = typer.Option(None, help="instead: all, or some of dominant,hde,ihde,learned"),
    out: Path = typer.Option(None, "--out", "-o", help="folder for a page with pictures, CSV and JSON"),
    json: bool = typer.Option(False, "--json", help="print everything as one JSON object"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    columns: Path = typer.Option(None, help="column map of text recordings, see the guide on recordings"),
) -> None:
    """Run every stance detector over recordings and say how far off each track comes out.

    With `--out` or `--json` also: steps found by windows of every length, and what each part of the method is worth
    where the truth is known. With `--orientations` the methods of orientation are compared instead, and strides and
    foot pitch with motion capture where heel and toe are known. With `--headings` the heading constraints are added to
    the filter one at a time, as in Gui's Table 3, and walks whose strides are known are bent by 8 to 12 degrees too.

    Example: `pdr compare --detectors all *.mcap --out compared` and then open `compared/compare.html`
    """
    from pdr_bringup_scripts.compare.comparing import Comparison, compare_recordings
    from pdr_bringup_scripts.compare.detector_comparing import of_detectors
    from pdr_bringup_scripts.compare.heading_comparing import of_headings
    from pdr_bringup_scripts.compare.orientation_comparing import of_orientations
    from pdr_bringup_scripts.problems import Problem
    from pdr_core.params import Params
    from pdr_core.params_file import load_params

    chosen = load_params(params) if params else Params()
    if orientations and headings:
        raise Problem("--orientations and --headings compare different things: one at a time")
    comparison: Comparison[Any]
    if headings:
        comparison = of_headings(chosen, headings)
    elif orientations:
        comparison = of_orientations(chosen, orientations)
    else:
        comparison = of_detectors(chosen, detectors, time_gates, bool(out or json))
    compare_recordings(recordings, columns, comparison, out, json)
