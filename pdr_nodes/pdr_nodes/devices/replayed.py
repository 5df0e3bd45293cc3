"""A recording as a device."""

from pathlib import Path

from pdr_core.params import DriverParams
from pdr_core.recording import RecordingError, Sensor, Session, open_recording
from pdr_nodes.devices.source import Source


def replayed(params: DriverParams) -> Source:
    """Return the recording that the parameters name; RecordingError if it cannot be opened."""
    if not params.recording:
        raise RecordingError("driver.recording is empty: name the recording to replay.")
    session = open_recording(Path(params.recording), Path(params.columns) if params.columns else None)
    sensor = chosen(session, params.sensor)
    return Source(f"{session.name} ({sensor.name})", sensor.pieces(), sensor.truth)


def chosen(session: Session, name: str) -> Sensor:
    """Return the sensor of that name, or the only one."""
    if name in session.sensors:
        return session.sensors[name]
    if not name and len(session.sensors) == 1:
        return next(iter(session.sensors.values()))
    raise RecordingError(f"{session.name}: set driver.sensor to one of {', '.join(session.sensors)}.")
