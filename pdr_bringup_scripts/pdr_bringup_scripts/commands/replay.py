"""`pdr replay`: plays a recording through the nodes."""

from pathlib import Path

import typer


def replay(
    recording: Path = typer.Argument(help="rosbag2 directory, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    out: Path = typer.Option(None, "--out", "-o", help="folder for recording, trajectory, result and report"),
    rate: float = typer.Option(1.0, help="speed; 0: as fast as the nodes take it"),
    sensor: str = typer.Option("", help="which sensor of the recording, if it has several"),
    feet: str = typer.Option(
        None, help="the left and the right foot of a person, LEFT,RIGHT; default: two sensors that are called so"
    ),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    as_recorded: bool = typer.Option(False, "--as-recorded", help="with the parameters that `pdr record` wrote down"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    namespace: str = typer.Option("pdr", help="where the topics are: /pdr/imu/data_raw, /pdr/odom ..."),
) -> None:
    """Play a recording through all nodes, live, on this machine's ROS graph.

    Example: `pdr replay walk.csv --rate 2`
    """
    from pdr_bringup_scripts.live.chain import checked_namespace
    from pdr_bringup_scripts.live.live_run import live_run
    from pdr_bringup_scripts.live.recorded_params import chosen_params
    from pdr_bringup_scripts.live.replaying import chosen_feet, replay_cast
    from pdr_bringup_scripts.run.run_folder import new_run_folder, show_result
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import changed
    from pdr_core.recording import open_recording

    sources = chosen_feet(open_recording(recording, column_map=columns), sensor, feet)
    chosen = chosen_params(params, as_recorded, recording, sources.values())
    choice = {"device": "replayed", "recording": str(recording.resolve()), "rate_factor": rate}
    choice["columns"] = str(columns.resolve()) if columns else ""
    cast = replay_cast(changed(chosen, "driver", **choice), sources)
    home = checked_namespace(namespace)
    folder = out or new_run_folder(f"replay-{recording.stem}")
    truths = dict(zip(cast.feet, sources.values(), strict=True))
    show_result(live_run(cast, folder, None, Terminal(), truths, home), folder)
