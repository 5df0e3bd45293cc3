"""What a foot shows without its gyro: the verdicts are those of the detector, and no memory of fixed size shows."""

import numpy as np
import pytest

from pdr_core.gait.accelerometer_steps import AccelerometerSteps
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline.gait_watch import STILL_VARIANCE, GaitWatch
from pdr_core.records import Flags, ImuBlock, joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.stance import StanceDetection, still_foot


@pytest.fixture(scope="module")
def walk() -> ImuBlock:
    params = {"motion": "smooth", "sensor_model": "consumer", "magnetometer": True}
    return simulated_walk(SimulationParams(walk="straight", walk_length_m=30.0, sample_rate_hz=100.0, **params)).imu


def later(imu: ImuBlock, by_s: float) -> ImuBlock:
    return imu._replace(stamp_ns=imu.stamp_ns + round(by_s * 1e9))


def broken(walk: ImuBlock) -> ImuBlock:
    """A gap, a clock that jumps back, stamps that repeat, and a force that is no number."""
    n = length(walk)
    again = joined([part(walk, 0, n // 2), later(part(walk, n // 2 + 40), 0.3), later(walk, -1000.0)])
    again.stamp_ns[500:503] = again.stamp_ns[500]
    again.accel_mps2[700] = np.nan
    return again


def verdicts(imu: ImuBlock, piece: int) -> Flags:
    watch = GaitWatch(Params())
    return np.concatenate([watch.run(part(imu, i, i + piece)).still for i in range(0, length(imu), piece)])


def detected(imu: ImuBlock, piece: int) -> Flags:
    told = changed(Params(), "stance", detector="acceleration_moving_variance", time_gate="none")
    told = changed(told, "detectors", acceleration_moving_variance_threshold=STILL_VARIANCE)
    stance = StanceDetection(told.stance, told.place, told.detectors)
    return np.concatenate([stance.run(part(imu, i, i + piece)).stance for i in range(0, length(imu), piece)])


@pytest.mark.parametrize("piece", [1, 7, 100, 100_000])
def test_the_verdicts_are_those_of_the_detector_and_known_at_once(walk: ImuBlock, piece: int) -> None:
    imu = broken(walk)
    assert length(imu) > still_foot.CAPACITY
    np.testing.assert_array_equal(verdicts(imu, piece), detected(imu, piece))


def seen(imu: ImuBlock, piece: int) -> list[tuple]:
    watch, out = GaitWatch(Params()), []
    for i in range(0, length(imu), piece):
        out += watch.run(part(imu, i, i + piece)).strides
    return [(s.step, s.before, s.stand) for s in out]


def figures(strides: list[tuple]) -> list[tuple]:
    """Plain numbers, which compare."""
    return [
        (
            step,
            *(
                (e.stamp_ns, e.force_mps2.tolist(), e.field_tesla.tolist(), np.array(e.impulse_mps).tolist())
                if e
                else None
                for e in ends
            ),
        )
        for step, *ends in strides
    ]


def test_pieces_change_nothing(walk: ImuBlock) -> None:
    pieces = [figures(seen(walk, piece)) for piece in (1, 5, 20)]
    assert len(pieces[0]) > 15
    assert pieces[0] == pieces[1] == pieces[2]


def test_who_stands_for_longer_than_any_memory_walks_on_as_before(walk: ImuBlock) -> None:
    """Three minutes at 100 Hz are more samples than a stand, a stride or a window may remember."""
    still = part(walk, 0, 200)
    long = joined([later(still, 2.0 * k) for k in range(90)])
    moved = later(walk, 2.0 * 90)
    after, usual = seen(joined([long, moved]), 50), seen(walk, 50)
    assert [s[0].stamp_ns - moved.stamp_ns[0] for s in after] == [s[0].stamp_ns - walk.stamp_ns[0] for s in usual]
    for (_, _, one), (_, _, other) in zip(after[1:], usual[1:], strict=True):
        np.testing.assert_array_equal(one.force_mps2, other.force_mps2)
        np.testing.assert_array_equal(one.impulse_mps, other.impulse_mps)
    np.testing.assert_allclose(after[0][2].impulse_mps, usual[0][2].impulse_mps, atol=2.0)  # by how the stand leans


def test_a_walk_faster_sampled_than_any_memory_holds_says_that_no_impulse_is_known() -> None:
    fast = SimulationParams(motion="smooth", walk="straight", walk_length_m=6.0, sample_rate_hz=20_000.0)
    imu = simulated_walk(fast).imu
    strides = seen(imu, 10_000)
    assert strides
    assert all(stand is None or stand.impulse_mps is None for _, _, stand in strides)


def test_the_same_strides_as_by_themselves(walk: ImuBlock) -> None:
    assert [s[0] for s in seen(walk, 50)] == AccelerometerSteps(Params().gait).run(walk).steps
