"""What a calibration of a magnetometer says to a person."""

from collections.abc import Iterator
from itertools import permutations

import numpy as np

from pdr_core.evaluation.report import Card
from pdr_core.evaluation.words import duration
from pdr_core.pipeline.mag_calibration import MagCalibration
from pdr_core.records import Floats

AXES = "xyz"


def in_words(found: MagCalibration) -> str:
    """Return a few sentences."""
    return " ".join(sentences(found))


def sentences(found: MagCalibration) -> Iterator[str]:
    """Yield what was found, from what matters most on."""
    yield f"The field is {microtesla(found.field_norm_tesla)} strong{dip_text(found)}."
    yield f"Calibrated, it scatters by {found.residual_tesla * 1e6:.2f} µT about that."
    offset = ", ".join(f"{value * 1e6:.1f}" for value in found.offset_tesla)
    yield f"Hard iron: {offset} µT. {axes_text(found)}"
    yield (
        f"By the calibration alone a heading is off by {np.rad2deg(found.heading_sd_rad):.2f}° (1 σ, worst attitude): "
        f"{found.fields} fields in {duration(found.duration_s)} show {found.coverage:.0%} of all directions."
    )


def microtesla(tesla: float) -> str:
    """Return a field strength."""
    return f"{tesla * 1e6:.1f} µT"


def dip_text(found: MagCalibration) -> str:
    """Return how steep the field is."""
    if found.dip_rad is None:
        return "; its dip is not known, as the sensor was never slow: mirrored axes would not show"
    return f" and points {np.rad2deg(abs(found.dip_rad)):.1f}° {'down' if found.dip_rad > 0.0 else 'up'}"


def axes_text(found: MagCalibration) -> str:
    """Return how the magnetometer's axes lie against those of the gyro."""
    if not found.axes_from_gyro:
        return "The gyro does not show how the axes lie: they are taken to be its own."
    Q = found.axes
    nearest = max(permutations(range(3)), key=lambda order: np.abs(Q[range(3), order]).sum())
    square = np.zeros((3, 3))
    square[range(3), nearest] = np.sign(Q[range(3), nearest])
    off_deg = np.rad2deg(np.arccos(np.clip(0.5 * (np.trace(Q @ square.T) - 1.0), -1.0, 1.0)))
    mirrored = "mirrored, " if np.linalg.det(Q) < 0.0 else ""
    return f"Axes, by the gyro: {order_text(square)}{mirrored}{off_deg:.1f}° off."


def order_text(square: Floats) -> str:
    """Return which axis is which, nothing where they are the same; `square`, (3, 3), has one 1 or -1 in each row."""
    if np.array_equal(square, np.eye(3)):
        return ""
    nearest = np.abs(square).argmax(axis=1)
    signs = ["-" if square[i, nearest[i]] < 0.0 else "" for i in range(3)]
    names = [f"{signs[i]}{AXES[nearest[i]]}" for i in range(3)]
    return f"x is the magnetometer's {names[0]}, y its {names[1]}, z its {names[2]}, "


def cards(found: MagCalibration) -> list[Card]:
    """Return the summary."""
    return [
        Card(microtesla(found.field_norm_tesla), "strength of the field"),
        Card("unknown" if found.dip_rad is None else f"{np.rad2deg(found.dip_rad):.1f}°", "dip"),
        Card(microtesla(float(np.linalg.norm(found.offset_tesla))), "hard iron"),
        Card(f"{found.residual_tesla * 1e6:.2f} µT", "left over"),
        Card(f"{np.rad2deg(found.heading_sd_rad):.2f}°", "of the heading uncertain"),
        Card(f"{found.coverage:.0%}", "of all directions seen"),
    ]
