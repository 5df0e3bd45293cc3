"""`pdr run`: estimates a recording offline, at full speed."""

from pathlib import Path

import typer


def run(
    recording: Path = typer.Argument(help="rosbag2 directory, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    out: Path = typer.Option(None, "--out", "-o", help="folder for trajectory, strides, result and report"),
    json: bool = typer.Option(False, "--json", help="print the result as one JSON object"),
    sensor: str = typer.Option(None, help="which sensor of the recording; default: all of them"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    detector: str = typer.Option(None, help="what tells a standing foot: adaptive, glrt ...; default: as in the file"),
    time_gate: str = typer.Option(None, help="what sorts out false stances: none, gait_phases, kmeans, kmeans_offline"),
    level_ground: bool = typer.Option(False, "--level-ground", help="hold the height of each floor; keeps stairs"),
    smooth: bool = typer.Option(False, "--smooth", help="let every estimate know the whole recording: go back over it"),
) -> None:
    """Estimate the walk in a recording, offline and at full speed.

    Example: `pdr run walk.csv --out walk_result` and then open `walk_result/report.html`
    """
    from pdr_bringup_scripts.book import FILES
    from pdr_bringup_scripts.offline import run_recording
    from pdr_bringup_scripts.options import known_name
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.evaluation.result import Hindsight, in_words
    from pdr_core.params import Params, changed
    from pdr_core.params_file import load_params
    from pdr_core.pipeline.stance_phases import OFFLINE, TIME_GATES, with_time_gate
    from pdr_core.recording import open_recording

    chosen = load_params(params) if params else Params()
    chosen = changed(chosen, "stance", detector=detector) if detector is not None else chosen
    if time_gate is not None:
        chosen = with_time_gate(chosen, known_name("--time-gate", time_gate, TIME_GATES))
    chosen = changed(chosen, "filter", level_ground=True) if level_ground else chosen
    session = open_recording(recording, column_map=columns)
    result = run_recording(session, chosen, sensor, out, Terminal(), Hindsight(smooth, time_gate == OFFLINE))
    print(result.to_json() if json else in_words(result))
    if out and not json:
        print(f"Written to {out}: {FILES}")
