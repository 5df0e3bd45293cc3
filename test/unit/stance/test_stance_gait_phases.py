import numpy as np
import pytest

from pdr_core.params import DetectorParams, PlaceParams, SimulationParams, StanceParams
from pdr_core.records import joined, part
from pdr_core.simulation import simulated_walk
from pdr_core.stance import StanceDetection
from pdr_core.stance.gait_phases import (
    HEEL_STRIKE,
    STANCE,
    SWING,
    TOE_OFF,
    GaitLimits,
    GaitPhases,
    fresh_state,
    phases,
)
from support.verdicts import span_of, verdicts

REST, DIP = ((0.4, True), (0.04, True))
STRIDE = (REST, (0.2, False), DIP, (0.4, False))
MS = 1_000_000
LIMITS = GaitLimits(50 * MS, 300 * MS, 100 * MS)


def gated(*spans):
    return GaitPhases(DetectorParams()).run(verdicts(*spans), final=True).stance


def test_a_dip_in_the_swing_is_no_stance_and_stances_are_kept():
    spans = STRIDE * 5
    found = gated(*spans)
    expected = verdicts(*spans).stance.copy()
    for stride in range(5):
        expected[span_of(4 * stride + 2, *spans)] = False
    np.testing.assert_array_equal(found, expected)


def test_a_stride_has_the_four_phases_of_figure_2():
    block = verdicts(*STRIDE * 3)
    found = phases(block.imu.stamp_ns, block.stance, LIMITS, fresh_state(), True)
    changes = found[np.flatnonzero(np.diff(found, prepend=-1))]
    assert changes.tolist() == [STANCE, TOE_OFF, SWING, HEEL_STRIKE] * 3


def test_a_wobble_is_no_toe_off():
    assert gated(REST, (0.045, False), DIP, (0.5, False)).sum() == 80 + 8


@pytest.mark.parametrize(("seconds", "stands"), [(0.095, False), (0.11, True)])
def test_a_foot_that_is_put_down_early_stands_once_it_has_lasted(seconds, stands):
    spans = (REST, (0.2, False), (seconds, True), (0.5, False))
    assert gated(*spans)[span_of(2, *spans)].tolist() == [stands] * round(seconds * 200)


def test_the_short_stances_of_a_run_are_kept():
    spans = (REST, *((0.55, False), (0.015, True)) * 10)
    np.testing.assert_array_equal(gated(*spans), verdicts(*spans).stance)


def test_after_a_gap_nobody_knows_the_phase():
    gate = GaitPhases(DetectorParams())
    before = verdicts(REST, (0.2, False))
    after = verdicts(DIP, (0.5, False), start_ns=int(before.imu.stamp_ns[-1]) + 500 * MS)
    found = joined([gate.run(before, final=False), gate.run(after, final=True)]).stance
    np.testing.assert_array_equal(found, joined([before, after]).stance)


def with_dips():
    """Return a walk in whose swings the foot is still for .06 s, .2 s after the toe-off, and where."""
    walk = simulated_walk(SimulationParams(walk="straight", walk_length_m=6.0), start_ns=10**18)
    toe_offs = np.flatnonzero(np.diff(walk.motion.stance.astype(int)) == -1)
    dips = np.concatenate([np.arange(at + 40, at + 52) for at in toe_offs])
    walk.imu.gyro_radps[dips], walk.imu.accel_mps2[dips] = 0.0, [0.0, 0.0, 9.81]
    return walk, dips


@pytest.mark.parametrize("detector", ["adaptive", "glrt", "angular_rate_energy", "three_conditions"])
def test_the_dips_of_figure_3_deceive_a_detector_but_not_the_gate(detector):
    walk, dips = with_dips()
    found = {}
    for gate in ("none", "gait_phases"):
        stage = StanceDetection(StanceParams(detector=detector, time_gate=gate), PlaceParams())
        found[gate] = joined([stage.run(part(walk.imu, 0, 700)), stage.run(part(walk.imu, 700)), stage.finish()]).stance
    assert found["none"][dips].mean() > 0.3
    assert not found["gait_phases"][dips].any()
    inside = np.convolve(walk.motion.stance, np.ones(9), "same") == 9
    np.testing.assert_array_equal(found["gait_phases"][inside], found["none"][inside])
