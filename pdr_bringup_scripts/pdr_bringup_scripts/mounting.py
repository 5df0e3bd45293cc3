"""Finds how a sensor sits on the foot and writes it down for the intake."""

import math
from pathlib import Path

import yaml

from pdr_bringup_scripts.problems import Problem
from pdr_core.evaluation.mounting_page import Orientations, write_mounting
from pdr_core.params import Params
from pdr_core.params_file import load_params, ros_parameters
from pdr_core.pipeline.mounting import FoundMounting, MountingSearch
from pdr_core.recording import Sensor, Session

ANGLES = ("mounting_roll_rad", "mounting_pitch_rad", "mounting_yaw_rad")
DIGITS = 6


def find(session: Session, sensor: Sensor, params: Path | None) -> FoundMounting:
    """Return how the sensor sits; Problem if the walk does not tell."""
    found = MountingSearch(load_params(params) if params else Params()).run(sensor.pieces())
    if isinstance(found, str):
        raise Problem(f"{session.path}: {found}; record some seconds of rest and then ten strides straight ahead")
    return found


def write_parameters(path: Path, params: Path | None, found: FoundMounting) -> None:
    """Write a parameter file: what the given one says, and the mounting."""
    known = ros_parameters(params, yaml.safe_load(params.read_text())) if params else {}
    angles = {name: round(angle, DIGITS) for name, angle in zip(ANGLES, found.angles_rad, strict=True)}
    groups = known | {"intake": (known.get("intake") or {}) | angles}
    path.write_text(yaml.safe_dump({"/**": {"ros__parameters": groups}}, sort_keys=False))


def write_page(path: Path, session: Session, found: FoundMounting) -> None:
    """Write the page that shows the alignment."""
    shown = Orientations(found.stamp_ns, found.before_xyzw, found.after_xyzw, found.rest)
    write_mounting(path, str(session.path), in_words(found), shown)


def in_words(found: FoundMounting) -> str:
    """Return what was found in a sentence or two."""
    roll, pitch, yaw = (f"{math.degrees(angle):.1f}°" for angle in found.angles_rad)
    sure, tilt = (math.degrees(sd) for sd in (found.mounting.yaw_sd_rad, found.mounting.tilt_sd_rad))
    strides = f"{found.mounting.strides} straight strides"
    text = f"The sensor sits rolled by {roll}, pitched by {pitch} and turned by {yaw} on the foot"
    text += f", by {strides}: the direction to {sure:.1f}°, the tilt to {tilt:.1f}°."
    if found.walking_yaw_rad is not None:
        bearing_deg = math.degrees(math.pi / 2.0 - found.walking_yaw_rad) % 360.0
        text += f" At the start the foot pointed {bearing_deg:.0f}° clockwise from magnetic north."
    return text
