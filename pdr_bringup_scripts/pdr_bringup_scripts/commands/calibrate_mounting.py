"""`pdr calibrate mounting`: how the sensor sits on the foot, from a walk."""

from pathlib import Path

import typer


def mounting(
    recording: Path = typer.Argument(help="a walk: stand for some seconds, then six strides or more straight ahead"),
    out: Path = typer.Option(..., "--out", "-o", help="parameter file to write, as `pdr run --params` takes it"),
    report: Path = typer.Option(None, help="page with the orientation before the alignment and after it, NAME.html"),
    json: bool = typer.Option(False, "--json", help="print what was found as one JSON object"),
    sensor: str = typer.Option("", help="which sensor of the recording; default: the only one"),
    params: Path = typer.Option(None, help="parameter file; what it says is kept in the file that is written"),
    columns: Path = typer.Option(None, help="column map of a text recording, see the guide on recordings"),
) -> None:
    """Find how the sensor sits on the foot, so that the foot's x axis is the walking direction and its z is up.

    Walk forwards: a walk that goes backwards all the time cannot be told from one that goes forwards.

    Example: `pdr calibrate mounting walk.csv --out mounting.yaml`, then `pdr run walk.csv --params mounting.yaml`
    """
    from pdr_bringup_scripts.mounting import find, in_words, write_page, write_parameters
    from pdr_bringup_scripts.run.which_sensors import only_sensor
    from pdr_core.recording import open_recording

    session = open_recording(recording, column_map=columns)
    found = find(session, only_sensor(session, sensor), params)
    write_parameters(out, params, found)
    if report:
        write_page(report, session, found)
    print(found.to_json() if json else f"{in_words(found)}\nWritten to {out}: give it to `pdr run --params {out}`")
