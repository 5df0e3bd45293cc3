"""Pairs a trajectory with its truth and judges it."""

from pathlib import Path
from typing import NamedTuple

from pdr_bringup_scripts.problems import Problem
from pdr_core.conventions import nanoseconds
from pdr_core.evaluation.association import interpolated, nearest
from pdr_core.evaluation.comparison import Comparison, compare
from pdr_core.evaluation.dropouts import measured
from pdr_core.records import Floats, Stamps, Truth


class Pairing(NamedTuple):
    """How rows are paired."""

    within_s: float | None  # None: the estimate is interpolated
    measured_only: bool


def paired(estimate: Truth, truth: Truth, how: Pairing) -> tuple[Stamps, Floats, Floats]:
    """Return stamps (n,), estimated and true positions (n, 3) of the rows that belong together."""
    if how.measured_only:
        rows = measured(truth.stamp_ns, truth.position_m)
        truth = Truth(truth.kind, truth.stamp_ns[rows], truth.position_m[rows])
    if how.within_s is None:
        return interpolated(estimate, truth)
    return nearest(estimate, truth, nanoseconds(how.within_s))


def evaluated(rows: tuple[Stamps, Floats, Floats], trajectory: Path, truth: Path) -> Comparison:
    """Return how far the estimate is off; Problem if too few rows belong together."""
    try:
        return compare(*rows)
    except ValueError as error:
        raise Problem(
            f"{trajectory} and {truth} have {error} at the same time: "
            "check that both count from the same moment, or raise --max-difference"
        ) from error
