"""`pdr convert`: any recording as a bag or a CSV file."""

from pathlib import Path

import typer


def convert(
    recording: Path = typer.Argument(help="rosbag2 directory, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    output: Path = typer.Argument(help="NAME.csv, NAME.mcap, or any other name for a rosbag2 directory (MCAP)"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    sensor: str = typer.Option(None, help="which sensor of the recording; default: all of them"),
    force: bool = typer.Option(False, "--force", help="replace what has that name already"),
) -> None:
    """Write the inertial samples of a recording, and its truth, in another format: exact to the last bit.

    Example: `pdr convert walk.bag walk` and then `pdr run walk`
    """
    from pdr_bringup_scripts.offline import chosen_sensors
    from pdr_bringup_scripts.saving import save
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.recording import open_recording

    session = open_recording(recording, column_map=columns)
    save(session, chosen_sensors(session, sensor), output, force, "Converting", Terminal())
