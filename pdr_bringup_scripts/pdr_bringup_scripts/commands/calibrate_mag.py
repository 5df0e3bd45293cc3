"""`pdr calibrate mag`: finds what is wrong with a magnetometer from a recording made for it."""

from pathlib import Path

import typer


def mag(
    recording: Path = typer.Argument(help="rosbag2 directory, .mcap, .db3, ROS 1 .bag, .csv or .mat"),
    out: Path = typer.Option(None, "--out", "-o", help="parameter file to write, for `pdr run --params`"),
    report: Path = typer.Option(None, help="page to write (HTML): the sphere before and after"),
    json: bool = typer.Option(False, "--json", help="print the calibration as one JSON object"),
    params: Path = typer.Option(None, help="parameter file to start from; what it says stays in --out"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
    sensor: str = typer.Option("", help="which sensor of the recording, if there are several"),
) -> None:
    """Calibrate the magnetometer: hard iron, soft iron, axes.

    Record half a minute while you turn the sensor slowly through all directions, outdoors and far from iron, with a
    short rest now and then. What such a recording does not determine is refused.

    Example: `pdr calibrate mag turned.mcap --out mag.yaml --report mag.html` and then
    `pdr run walk.mcap --params mag.yaml`
    """
    from pdr_bringup_scripts.calibrating import as_json, calibrated, check_outputs, write_page, write_parameters
    from pdr_bringup_scripts.calibration_words import in_words
    from pdr_bringup_scripts.run.which_sensors import only_sensor
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import params_from_mapping
    from pdr_core.params_file import load_mapping
    from pdr_core.recording import open_recording

    check_outputs((recording, columns), (out, report))
    given, terminal = load_mapping(params) if params else {}, Terminal()
    session = open_recording(recording, column_map=columns)
    found = calibrated(session, only_sensor(session, sensor), params_from_mapping(given), given)
    for notice in [*session.notices, *found.notices]:
        terminal.say(f"Warning: {notice.text.rstrip('.')}.")
    print(as_json(found.calibration) if json else in_words(found.calibration))
    if out:
        write_parameters(out, found.calibration, given)
        terminal.say(f"Written to {out}: give it to `pdr run --params`.")
    if report:
        write_page(report, str(recording), found)
        terminal.say(f"Written to {report}: open it in a browser.")
