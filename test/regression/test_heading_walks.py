"""Real walks with each heading constraint, without the magnetometer: what it may cost; `-s` shows the figures."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from pdr_core.bench.heading_ablation import CONSTRAINTS, WITHOUT, study, tracked, variants
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.heading_study import HeadingStudy
from pdr_core.params import Params
from pdr_core.recording import open_recording

BEST = "learned"
WORST_OF_WALKS = {"dominant": 1.2, "hde": 1.4, "ihde": 1.4, BEST: 1.1}  # times that without


def walk(path: Path) -> Walk:
    (sensor,) = open_recording(path).sensors.values()
    return Walk(path.stem, list(sensor.pieces()), sensor.truth)


@pytest.fixture(scope="module")
def studies(recordings: Path) -> list[HeadingStudy]:
    paths = sorted((recordings / "tile_walks_marg").glob("*.csv"))
    assert len(paths) == 5
    return [study(walk(path), Params()) for path in paths]


@pytest.fixture(scope="module")
def ate2_m(studies: list[HeadingStudy]) -> Mapping[str, np.ndarray]:
    found = {name: np.array([s.scores[name].ate2_m for s in studies]) for name in studies[0].scores}
    for name, errors_m in found.items():
        print(f"\n{name}: {np.round(errors_m, 3)} mean {np.mean(errors_m):.3f} m", end="")
    return found


def test_each_part_of_the_method_helps_or_costs_nothing(ate2_m: Mapping[str, np.ndarray]) -> None:
    alone, first_rest, later_rests = (np.mean(errors_m) for errors_m in list(ate2_m.values())[:3])
    assert first_rest < 0.5 * alone
    assert later_rests <= 1.01 * first_rest


@pytest.mark.parametrize("name", CONSTRAINTS)
def test_no_constraint_harms_a_walk_much(ate2_m: Mapping[str, np.ndarray], name: str) -> None:
    assert np.mean(ate2_m[name]) <= 0.25
    assert (ate2_m[name] <= WORST_OF_WALKS[name] * ate2_m[WITHOUT]).all()


def test_the_constraints_are_used(studies: list[HeadingStudy]) -> None:
    for name in CONSTRAINTS:
        assert sum(s.scores[name].held for s in studies) >= 15, name


@pytest.mark.parametrize("name", CONSTRAINTS)
def test_a_bent_corridor_fools_no_constraint_much(studies: list[HeadingStudy], name: str) -> None:
    bent = [bend.ate2_m for s in studies for bend in s.bends]
    assert len(bent) >= 100
    with_m, without_m = (np.mean([errors[n] for errors in bent]) for n in (name, WITHOUT))
    print(f"\n{name}: {len(bent)} bends {with_m:.3f} m, {with_m / without_m:.2f} times {without_m:.3f} m", end="")
    assert with_m <= 1.7 * without_m


def test_walks_in_a_small_room_stay_as_they_are(recordings: Path) -> None:
    walks = [walk(path) for path in sorted((recordings / "pyshoe_vicon").glob("*.mat"))]
    assert len(walks) == 28
    rows = variants(Params(), CONSTRAINTS)
    mean_m = {n: np.mean([tracked(w, rows[n]).score.ate2_m for w in walks]) for n in (WITHOUT, *CONSTRAINTS)}
    print(f"\nVicon: {mean_m}", end="")
    for name in CONSTRAINTS:
        assert mean_m[name] == pytest.approx(mean_m[WITHOUT], rel=0.02)
