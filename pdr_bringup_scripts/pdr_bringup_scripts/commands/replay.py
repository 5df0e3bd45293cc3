"""`pdr replay`: plays a recording through the nodes."""

from pathlib import Path

import typer


def replay(
    recording: Path = typer.Argument(help="rosbag2 directory, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    out: Path = typer.Option(None, "--out", "-o", help="folder for recording, trajectory, result and report"),
    rate: float = typer.Option(1.0, help="speed; 0: as fast as the nodes take it"),
    sensor: str = typer.Option("", help="which sensor of the recording, if it has several"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    namespace: str = typer.Option("pdr", help="where the topics are: /pdr/imu/data_raw, /pdr/odom ..."),
) -> None:
    """Play a recording through all nodes, live, on this machine's ROS graph.

    Example: `pdr replay walk.csv --rate 2`
    """
    from pdr_bringup_scripts.chain import checked_namespace
    from pdr_bringup_scripts.live import live_run
    from pdr_bringup_scripts.offline import has_magnetometer, only_sensor
    from pdr_bringup_scripts.run_folder import new_run_folder, show_result
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params, changed
    from pdr_core.params_file import load_params
    from pdr_core.recording import open_recording

    source = only_sensor(open_recording(recording, column_map=columns), sensor)
    chosen = load_params(params) if params else Params()
    choice = {"device": "replayed", "recording": str(recording.resolve()), "rate_factor": rate, "sensor": source.name}
    choice["columns"] = str(columns.resolve()) if columns else ""
    chosen = changed(chosen, "node", magnetometer=has_magnetometer(source))
    home = checked_namespace(namespace)
    folder = out or new_run_folder(f"replay-{recording.stem}")
    result = live_run(changed(chosen, "driver", **choice), folder, None, Terminal(), source, home)
    show_result(result, folder)
