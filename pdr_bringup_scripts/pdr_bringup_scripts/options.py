"""What the range of an option without an upper end lets through."""

import typer

from pdr_bringup_scripts.problems import Problem

LARGEST = 1e9  # seconds or metres


def finite(option: typer.CallbackParam, value: float | None) -> float | None:
    """Return the value of an option; Problem if it is infinite or beyond all that can be meant."""
    if value is not None and value > LARGEST:
        raise Problem(f"{option.opts[0]} {value} is more than can be meant: give a finite number up to {LARGEST:g}")
    return value
