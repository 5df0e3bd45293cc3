"""Calibrates the magnetometer of a recording, says how that went and writes it down."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from pdr_bringup_scripts.calibration_words import AXES, cards, in_words
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.provenance import VERSION
from pdr_core.evaluation.mag_page import FieldView, mag_page
from pdr_core.parameter import Groups
from pdr_core.params import Params
from pdr_core.params_file import params_text
from pdr_core.pipeline.mag_calibration import (
    CalibratedRecording,
    CalibrationError,
    MagCalibration,
    calibrate_magnetometer,
)
from pdr_core.recording import Sensor, Session


def check_outputs(inputs: Iterable[Path | None], outputs: Iterable[Path | None]) -> None:
    """Problem if a file that is to be written is one that is read."""
    read = {path.resolve() for path in inputs if path}
    for path in outputs:
        if path and path.resolve() in read:
            raise Problem(f"{path} is what the calibration is made from: choose another name")


def calibrated(session: Session, sensor: Sensor, params: Params, given: Groups) -> CalibratedRecording:
    """Return the calibration of a sensor; Problem where the recording does not determine it.

    `given` is what stands in the parameter file: a latitude that nobody has written there is not known.
    """
    latitude_deg = params.place.latitude_deg if "latitude_deg" in given.get("place", {}) else None
    try:
        return calibrate_magnetometer(sensor.pieces(), params, latitude_deg)
    except CalibrationError as error:
        raise Problem(f"{session.path}, {sensor.name}: {error}") from error


def as_mapping(found: MagCalibration) -> dict[str, Any]:
    """Return all figures as JSON knows them."""
    return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in vars(found).items()}


def as_json(found: MagCalibration) -> str:
    """Return all figures as one JSON object."""
    return json.dumps(as_mapping(found), indent=2)


def as_parameters(found: MagCalibration) -> dict[str, dict[str, float]]:
    """Return the parameters that hold the calibration, with digits that matter."""
    intake = {f"mag_offset_{axis}_tesla": rounded(v, 10) for axis, v in zip(AXES, found.offset_tesla, strict=True)}
    for row, values in zip(AXES, found.matrix, strict=True):
        intake |= {f"mag_matrix_{row}{column}": rounded(v, 6) for column, v in zip(AXES, values, strict=True)}
    if found.dip_rad is None:
        return {"intake": intake}
    place = {
        "field_norm_tesla": rounded(found.field_norm_tesla, 9),
        "field_dip_deg": rounded(np.rad2deg(found.dip_rad), 2),
    }
    return {"intake": intake, "place": place}


def rounded(value: float, digits: int) -> float:
    """Return so many decimals, as Python's own number."""
    return round(float(value), digits)


def write_parameters(path: Path, found: MagCalibration, given: Groups) -> None:
    """Write a parameter file: what stands in the given one, and the calibration."""
    new = as_parameters(found)
    merged = {group: {**given.get(group, {}), **new.get(group, {})} for group in {**given, **new}}
    path.write_text(params_text(merged), encoding="utf-8")


def write_page(path: Path, recording: str, found: CalibratedRecording) -> None:
    """Write the page with the sphere before and after."""
    one = found.calibration
    view = FieldView(found.stamp_ns, found.field_tesla, one.applied(found.field_tesla), one.field_norm_tesla)
    path.write_text(mag_page(recording, in_words(one), cards(one), view, VERSION), encoding="utf-8")
