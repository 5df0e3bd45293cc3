"""`pdr convert`: any recording as a bag or a CSV file, at its own rate or at a lower one."""

from pathlib import Path

import typer


def convert(
    recording: Path = typer.Argument(help="rosbag2 directory, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    output: Path = typer.Argument(help="NAME.csv, NAME.mcap, or a name without an ending for a rosbag2 directory"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    sensor: str = typer.Option(None, help="which sensor of the recording; default: all of them"),
    rate: float = typer.Option(None, min=0.1, help="lower the rate [Hz], filtered as a sensor does it"),
    force: bool = typer.Option(False, "--force", help="replace what has that name already"),
) -> None:
    """Write the inertial samples of a recording, and its truth, in another format: exact to the last bit.

    With --rate every k-th sample is kept, as near to the rate as that comes, after a low-pass filter.

    Example: `pdr convert walk.bag walk` and then `pdr run walk`
    """
    from pdr_bringup_scripts.run.which_sensors import chosen_sensors
    from pdr_bringup_scripts.saving import save, slower
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.recording import open_recording

    session, terminal = open_recording(recording, column_map=columns), Terminal()
    sensors = chosen_sensors(session, sensor)
    if rate is not None:
        sensors = [slower(one, rate, terminal) for one in sensors]
    save(session, sensors, output, force, "Converting", terminal)
