"""`pdr run`: estimates a recording offline, at full speed."""

from pathlib import Path

import typer


def run(
    recording: Path = typer.Argument(help="rosbag2 directory, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    out: Path = typer.Option(None, "--out", "-o", help="folder for trajectory, strides, result and report"),
    json: bool = typer.Option(False, "--json", help="print the result as one JSON object"),
    sensor: str = typer.Option(None, help="which sensor of the recording; default: all of them"),
    feet: str = typer.Option(None, help="the sensors of a person's feet, LEFT,RIGHT; default: two that are called so"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    as_recorded: bool = typer.Option(False, "--as-recorded", help="with the parameters that `pdr record` wrote down"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    detector: str = typer.Option(None, help="what tells a standing foot: adaptive, glrt ...; default: as in the file"),
    time_gate: str = typer.Option(None, help="what sorts out false stances: none, gait_phases, kmeans, kmeans_offline"),
    level_ground: bool = typer.Option(False, "--level-ground", help="hold the height of each floor; keeps stairs"),
    heading: str = typer.Option(None, help="hold the heading on straight lines: none, dominant, hde, ihde, learned"),
    smooth: bool = typer.Option(False, "--smooth", help="let every estimate know the whole recording: go back over it"),
    pipeline: str = typer.Option("foot", help="where the sensor is: foot, or chest, a card that is worn there"),
    adaptive: bool = typer.Option(False, "--adaptive", help="as if the gyro had been off where strides are reckoned"),
    external: str = typer.Option("", help="topic in the same bag with somebody else's odometry: compare with it"),
    aid: bool = typer.Option(False, "--aid", help="with --external: let it correct the track too"),
    at: list[str] = typer.Option([], help="SECONDS:X,Y, where on the map she was then; twice or more: lay it there"),
) -> None:
    """Estimate the walk in a recording, offline and at full speed.

    Example: `pdr run walk.csv --out walk_result` and then open `walk_result/report.html`
    """
    from pdr_bringup_scripts.live.recorded_params import chosen_params
    from pdr_bringup_scripts.run.known_points import known_point
    from pdr_bringup_scripts.run.run_choice import estimated
    from pdr_bringup_scripts.run.run_folder import say
    from pdr_bringup_scripts.run.run_options import RunOptions
    from pdr_bringup_scripts.run.which_sensors import chosen_sensors, feet_of
    from pdr_core.recording import open_recording

    walk, options = open_recording(recording, column_map=columns), RunOptions(
        out=out, sensor=sensor, feet=feet, detector=detector, time_gate=time_gate, level_ground=level_ground,
        heading=heading, smooth=smooth, pipeline=pipeline, adaptive=adaptive, external=external, aid=aid,
        at=tuple(map(known_point, at)),
    )  # fmt: skip
    told = chosen_params(params, as_recorded, recording, feet_of(walk, feet) if feet else chosen_sensors(walk, sensor))
    result = estimated(walk, options.applied_to(told), options)
    say(result, out, json)
