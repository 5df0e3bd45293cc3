"""Both feet in `pdr bench --dual`: paper 004's experiment with its control, and walks with turns and curves."""

import os

import pytest

from pdr_core.bench.dual_tables import ERRORS, FEET, WALKS, DualRow, row
from pdr_core.bench.dual_walks import REPETITIONS, DualTrial, dual_walk

pytestmark = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


@pytest.fixture(scope="module")
def rows() -> dict[tuple[str, float, str], DualRow]:
    found = {}
    for kind in ((*walk, errors) for walk in WALKS for errors in ERRORS):
        found[kind] = row([dual_walk(DualTrial(*kind, seed)) for seed in range(REPETITIONS)])
        print(f"\n{found[kind]}", end="")
    return found


def test_together_the_feet_go_straight(rows: dict[tuple[str, float, str], DualRow]) -> None:
    r = rows["straight", 76.0, "mirrored"]
    assert r.end_error_alone_m > 1.0
    assert r.ratio <= 0.6
    assert {foot: r.lateral_m[foot] for foot in FEET if abs(r.lateral_m[foot][0]) > r.lateral_bound_m(foot)} == {}


def test_errors_that_are_alike_are_not_made_worse(rows: dict[tuple[str, float, str], DualRow]) -> None:
    assert rows["straight", 76.0, "alike"].ratio <= 1.05


@pytest.mark.parametrize("walk", WALKS[1:])
@pytest.mark.parametrize("errors", ERRORS)
def test_turns_and_curves_are_no_worse(rows, walk, errors) -> None:
    assert rows[(*walk, errors)].ratio <= 1.05
