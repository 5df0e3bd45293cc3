"""Which options of a command go together, and where a sensor may be worn."""

from collections.abc import Collection, Iterable
from typing import NamedTuple

from pdr_bringup_scripts.problems import Problem
from pdr_core.evaluation.result import CHEST

FOOT = "foot"
PLACES = (FOOT, CHEST)


class Alone(NamedTuple):
    """An option, why it goes alone, and what it does not go with."""

    option: str
    why: str
    without: tuple[str, ...]


def check_together(given: Collection[str], rules: Iterable[Alone]) -> None:
    """Problem if options were given that do not go together."""
    for option, why, without in rules:
        if option in given and (wrong := [other for other in without if other in given]):
            raise Problem(f"{option} {why}: leave out {' and '.join(wrong)}")
