"""Strides from the accelerometer alone: every gait, rate and mounting of the simulator, and broken streams."""

from itertools import pairwise

import numpy as np
import pytest
from accelerometer_cases import BEGIN_NS, row, walk
from scipy.spatial.transform import Rotation

from pdr_core.gait.accelerometer_steps import AccelerometerSteps, GaitSeen
from pdr_core.params import GaitParams
from pdr_core.records import ImuBlock, joined, length, part
from pdr_core.records_gait import Behaviour, GaitStep
from pdr_core.simulation.foot_motion import FootCourse
from pdr_core.simulation.gait import RUN, SHUFFLE, STAIRS_DOWN, STAIRS_UP, STROLL, WALK, Gait, Stride

GAITS = {"walk": WALK, "stroll": STROLL, "run": RUN, "shuffle": SHUFFLE, "up": STAIRS_UP, "down": STAIRS_DOWN}
RATES_HZ = (20.0, 33.0, 50.0, 100.0, 200.0, 400.0)


def seen(imu: ImuBlock) -> GaitSeen:
    return AccelerometerSteps(GaitParams()).run(imu)


def steps(imu: ImuBlock) -> list[GaitStep]:
    return seen(imu).steps


def pieces(imu: ImuBlock, piece: int) -> GaitSeen:
    gait = AccelerometerSteps(GaitParams())
    out = [gait.run(part(imu, i, i + piece)) for i in range(0, length(imu), piece)]
    stamp_ns, behaviour = (np.concatenate([getattr(o, name) for o in out]) for name in ("stamp_ns", "behaviour"))
    return GaitSeen(stamp_ns, behaviour, [step for o in out for step in o.steps])


@pytest.mark.parametrize("rate_hz", RATES_HZ)
@pytest.mark.parametrize("gait", GAITS.values(), ids=list(GAITS))
def test_every_stride_is_found(gait: Gait, rate_hz: float) -> None:
    found = steps(walk([Stride(gait)] * 15, rate_hz))
    assert [step.index for step in found] == list(range(1, 16))
    wanted = Behaviour.RUNNING if gait is RUN else Behaviour.WALKING
    assert {step.behaviour for step in found} == {wanted}
    assert np.median([s.frequency_hz for s in found]) == pytest.approx(1.0 / Stride(gait).duration_s, rel=0.04)


@pytest.mark.parametrize("pace", [0.85, 1.2, 1.6, 2.0])
@pytest.mark.parametrize("gait", [WALK, RUN], ids=["walk", "run"])
def test_at_every_pace(gait: Gait, pace: float) -> None:
    assert len(steps(walk([Stride(gait.paced(pace))] * 20))) == 20


@pytest.mark.parametrize("seed", range(6))
def test_in_any_mounting(seed: int) -> None:
    strides = [*row(WALK, 6), *row(RUN, 6)]
    straight, turned = steps(walk(strides)), steps(walk(strides, mounting=Rotation.random(random_state=seed)))
    assert len(straight) == len(turned) == 12
    assert [s.behaviour for s in straight] == [s.behaviour for s in turned]
    for a, b in zip(straight, turned, strict=True):
        assert abs(a.stamp_ns - b.stamp_ns) <= 40_000_000
        assert a.accel_mean_abs_mps2 == pytest.approx(b.accel_mean_abs_mps2, rel=0.1, abs=0.1)


def test_a_hit_is_where_the_foot_comes_down() -> None:
    strikes_s = FootCourse([Stride(WALK)] * 12).strikes_s
    found = steps(walk([Stride(WALK)] * 12, 200.0))
    late_s = [(step.stamp_ns - BEGIN_NS) * 1e-9 - strike_s for step, strike_s in zip(found, strikes_s, strict=True)]
    assert 0.0 < np.mean(late_s) < WALK.strike_s + 0.05  # the foot is down when the toes are
    assert np.std(late_s) < 0.015
    assert [a.stamp_ns - b.start_ns for a, b in pairwise(found)] == [0] * 11


@pytest.mark.parametrize("name", ["accel_mean_mps2", "accel_max_mps2", "accel_min_mps2", "accel_mean_abs_mps2"])
def test_figures_do_not_depend_on_the_rate(name: str) -> None:
    slow, fast = (steps(walk([Stride(WALK)] * 12, rate_hz, shock_mps2=0.0)) for rate_hz in (20.0, 400.0))
    assert np.median([getattr(s, name) for s in slow]) == pytest.approx(
        np.median([getattr(s, name) for s in fast]), rel=0.05
    )


def test_figures_are_those_of_the_norm_beside_gravity() -> None:
    step = steps(walk([Stride(WALK)] * 12))[5]
    assert step.accel_min_mps2 < 0.0 < step.accel_mean_mps2 < step.accel_mean_abs_mps2 < step.accel_max_mps2


@pytest.mark.parametrize("piece", [1, 13, 400])
def test_sample_by_sample_is_the_same(piece: int) -> None:
    imu = walk([*row(WALK, 4, pause_s=2.5), *row(RUN, 5), *row(WALK, 3)])
    imu = joined([imu, imu._replace(stamp_ns=imu.stamp_ns + 60_000_000_000)])
    whole, cut = seen(imu), pieces(imu, piece)
    assert cut.steps == whole.steps
    assert np.array_equal(cut.stamp_ns, whole.stamp_ns)
    assert np.array_equal(cut.behaviour, whole.behaviour)


def test_later_stamps_shift_nothing() -> None:
    imu = walk(row(WALK, 6))
    later = imu._replace(stamp_ns=imu.stamp_ns - BEGIN_NS - 5_000_000_000)  # stamps may be negative
    assert [s.stamp_ns + BEGIN_NS + 5_000_000_000 for s in steps(later)] == [s.stamp_ns for s in steps(imu)]


@pytest.mark.parametrize("jump_s", [3.0, -200.0])
def test_a_gap_costs_the_strides_it_hides_and_no_more(jump_s: float) -> None:
    imu = walk([Stride(WALK)] * 20)
    shifted = imu.stamp_ns + np.where(imu.stamp_ns > BEGIN_NS + 12_000_000_000, round(jump_s * 1e9), 0)
    found = steps(imu._replace(stamp_ns=shifted))
    assert 18 <= len(found) <= 20
    assert all(0.2 < s.frequency_hz < 2.0 and np.isfinite(s.accel_mean_mps2) for s in found)
    assert [s.index for s in found] == list(range(1, len(found) + 1))


def test_a_foot_that_was_never_seen_standing_is_unknown() -> None:
    imu = walk([Stride(RUN)] * 20)
    running = part(imu, 500, 1200)
    known = seen(running)
    assert set(known.behaviour.tolist()) == {Behaviour.UNKNOWN.value}
    assert known.steps == []
