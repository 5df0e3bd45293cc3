"""`pdr evaluate`: how far a trajectory is from the truth."""

from pathlib import Path

import typer

from pdr_bringup_scripts.options import finite


def evaluate(
    trajectory: Path = typer.Argument(help=".tum, or a .csv with t_s or t_ns, x_m, y_m, z_m"),
    truth: Path = typer.Argument(help="the same, or any recording that holds positions as its truth"),
    json: bool = typer.Option(False, "--json", help="print the figures as one JSON object"),
    report: Path = typer.Option(None, help="write a page with pictures to this .html file"),
    max_difference: float = typer.Option(
        0.01, min=0.0, callback=finite, help="rows belong together up to this difference of stamps [s]"
    ),
    interpolate: bool = typer.Option(False, help="interpolate the trajectory at the stamps of the truth instead"),
    measured: bool = typer.Option(False, help="leave out rows where motion capture lost the foot, as `pdr run` does"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    sensor: str = typer.Option("", help="which sensor of the recording, if it has several"),
) -> None:
    """Compare a trajectory with the truth: ATE2, ATE3, the ATE that evo gives, and the error per metre.

    Example: `pdr evaluate walk_result/trajectory.tum walk.mcap --report page.html`
    """
    from pdr_bringup_scripts.evaluating import Pairing, evaluated, paired
    from pdr_bringup_scripts.problems import Problem
    from pdr_core.evaluation.comparison import in_words
    from pdr_core.evaluation.comparison_page import write_comparison
    from pdr_core.recording.positions import open_positions

    if report and report.suffix.lower() != ".html":
        raise Problem(f"--report {report}: the page needs a name that ends in .html")
    estimate, true = open_positions(trajectory), open_positions(truth, columns, sensor)
    rows = paired(estimate, true, Pairing(None if interpolate else max_difference, measured))
    result = evaluated(rows, trajectory, truth)
    print(result.to_json() if json else in_words(result))
    if report:
        write_comparison(report, result, *rows)
