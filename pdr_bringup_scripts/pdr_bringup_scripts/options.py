"""What options let through whose type alone lets through too much."""

from collections.abc import Sequence

import typer

from pdr_bringup_scripts.problems import Problem

LARGEST = 1e9  # seconds or metres


def finite(option: typer.CallbackParam, value: float | None) -> float | None:
    """Return the value of an option; Problem if it is infinite or beyond all that can be meant."""
    if value is not None and value > LARGEST:
        raise Problem(f"{option.opts[0]} {value} is more than can be meant: give a finite number up to {LARGEST:g}")
    return value


def known_name(option: str, name: str, known: Sequence[str]) -> str:
    """Return the name that was given to an option; Problem if it is none of those that are known."""
    if name not in known:
        raise Problem(f"{option} {name}: there is none of that name; choose from {', '.join(known)}")
    return name
