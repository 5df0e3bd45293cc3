"""Recordings: opened through one door whatever their format, and the files that a run writes."""

from pdr_core.recording.opening import open_recording
from pdr_core.recording.session import Arrivals, RecordingError, Sensor, Session

__all__ = ["Arrivals", "RecordingError", "Sensor", "Session", "open_recording"]
