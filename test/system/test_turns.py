"""Samples of two feet in turn, and fixes between them where they stand in the recording."""

from functools import partial

import numpy as np
import pytest

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.known_points import KnownPoint, arrivals_of
from pdr_bringup_scripts.run.turns import PIECE, Beside, in_turn
from pdr_bringup_scripts.simulated import pieces
from pdr_core.recording import Arrivals, Sensor
from pdr_core.records import inertial_block, joined, length
from pdr_core.records_external import FixBlock, unknown_yaws

STEP_NS = 10_000_000


def sensor(name: str, count: int, first_ns: int = 0) -> Sensor:
    """A sensor whose angular rate counts its samples."""
    numbers, zeros = np.arange(count), np.zeros((count, 3))
    rates = np.repeat(1.0 * numbers[:, None], 3, axis=1)
    imu = inertial_block(first_ns + numbers * STEP_NS, rates, zeros, zeros[:, 0], zeros[:, 0])

    return Sensor(name, None, partial(pieces, imu))


def arrivals(*after: tuple[int, ...]) -> Arrivals:
    n = len(after)
    fixes = FixBlock(np.arange(n), np.zeros((n, 3)), np.zeros((n, 3)), unknown_yaws(n))
    return Arrivals(fixes, np.array(after))


def told(sensors: list[Sensor], come: Arrivals) -> tuple[dict, list]:
    """Return the samples of each sensor, and before each fix how many of each had come."""
    pieces, seen = {one.name: [] for one in sensors}, []

    def tell(fixes: FixBlock) -> None:
        counts = [sum(map(length, of_one)) for of_one in pieces.values()]
        seen.extend((int(number), *counts) for number in fixes.stamp_ns)

    for name, piece in in_turn(sensors, Beside(come, tell)):
        if piece:
            pieces[name].append(piece)
    return pieces, seen


def test_each_fix_is_told_where_it_stands_between_the_samples_of_both() -> None:
    after = [(0, 0), (3, 0), (3, 0), (500, 2), (1000, 9000), (9990, 9000)]
    pieces, seen = told([sensor("left", 10_000), sensor("right", 9_000)], arrivals(*after))
    assert seen == [(i, *counts) for i, counts in enumerate(after)]
    for name, count in (("left", 10_000), ("right", 9_000)):
        np.testing.assert_array_equal(joined(pieces[name]).gyro_radps[:, 0], np.arange(count))


def test_one_sensor_alone_is_cut_there_too() -> None:
    _, seen = told([sensor("imu", 10_000)], arrivals((7,), (PIECE,), (9_999,), (10_000,)))
    assert seen == [(0, 7), (1, PIECE), (2, 9_999), (3, 10_000)]


def test_a_foot_that_ends_early_is_waited_for_no_longer() -> None:
    _, seen = told([sensor("left", 100), sensor("right", 1_000)], arrivals((100, 200), (100, 800)))
    assert seen == [(0, 100, 200), (1, 100, 800)]


def test_without_fixes_no_foot_runs_far_ahead_of_the_other() -> None:
    """Whenever each of them began."""
    done = {"left": 0, "right": 0}
    ends = []
    for name, piece in in_turn([sensor("left", 20_000), sensor("right", 20_000, first_ns=10**18)]):
        done[name] += length(piece) if piece else 0
        ends += [name] if piece is None else []
        assert abs(done["left"] - done["right"]) <= PIECE
    assert sorted(ends) == ["left", "right"]


def test_known_points_stand_at_the_same_time_of_each_foot() -> None:
    """By the stamps of the first one, whatever clock the other has."""
    feet = [sensor("left", 1_000, first_ns=5), sensor("right", 1_000, first_ns=10**18)]
    come = arrivals_of([KnownPoint(4.0, 1.0, 2.0), KnownPoint(0.0, 0.0, 0.0)], feet)
    assert come.fixes.stamp_ns.tolist() == [5, 4_000_000_005]
    assert come.fixes.position_m.tolist() == [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0]]
    assert come.after_samples.tolist() == [[1, 1], [401, 401]]


@pytest.mark.parametrize("counts", [(0, 10), (0, 0)])
def test_points_beside_no_samples_are_none(counts: tuple[int, int]) -> None:
    come = arrivals_of([KnownPoint(4.0, 1.0, 2.0)], [sensor(str(i), n) for i, n in enumerate(counts)])
    assert length(come.fixes) == 0
    assert come.after_samples.shape == (0, 2)


def test_the_known_point_outside_the_recording_is_the_one_that_is_named() -> None:
    with pytest.raises(Problem, match=r"--at -3: the recording of left lasts"):
        arrivals_of([KnownPoint(4.0, 1.0, 2.0), KnownPoint(-3.0, 0.0, 0.0)], [sensor("left", 1_000)])
