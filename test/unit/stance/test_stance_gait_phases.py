import numpy as np
import pytest

from pdr_core.params import DetectorParams, PlaceParams, SimulationParams, StanceParams
from pdr_core.records import joined, length, part
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
from support.verdicts import longest_wait_s, span_of, verdicts

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


def stage(gate="gait_phases", phases_s=None):
    return StanceDetection(StanceParams(detector="glrt", time_gate=gate), PlaceParams(), phases_s=phases_s)


def test_a_stream_that_ends_in_a_dip_loses_no_sample():
    walk, dips = with_dips()
    cut = part(walk.imu, 0, int(dips[8]) + 4)
    gated = stage()
    first = gated.run(cut)
    assert length(first) < length(cut) - 8  # what waits is more than half a window
    np.testing.assert_array_equal(joined([first, gated.finish()]).imu.stamp_ns, cut.stamp_ns)


def test_a_dip_is_judged_within_the_latency():
    walk, _ = with_dips()
    gated, period_s = stage(), 0.005
    waited_s = longest_wait_s(gated, walk.imu)
    assert stage("none").latency_s + period_s < waited_s <= gated.latency_s + 2 * period_s


def test_a_clock_that_is_set_back_in_a_swing_begins_anew():
    walk, dips = with_dips()
    at = int(dips[0]) - 10
    back = walk.imu._replace(stamp_ns=walk.imu.stamp_ns.copy())
    back.stamp_ns[at:] -= 10**12
    gated, fresh = stage(), stage()
    found = joined([gated.run(back), gated.finish()]).stance
    alone = joined([fresh.run(part(back, at)), fresh.finish()]).stance
    np.testing.assert_array_equal(found[at:], alone)
    assert alone[10:22].any()  # nobody knows that the foot is in a swing


@pytest.mark.parametrize("gate", ["gait_phases", "kmeans"])
@pytest.mark.parametrize("after", range(-6, 18, 3))
def test_a_pause_of_the_stream_in_a_dip_and_a_gap_in_a_recording_are_the_same(gate, after):
    walk, dips = with_dips()
    cut = int(dips[0]) + after
    late = part(walk.imu, cut + 200)
    late = late._replace(stamp_ns=late.stamp_ns + 500 * MS)
    live, offline = (stage(gate, np.array([0.03, 0.4] * 10)) for _ in range(2))
    heard = joined([live.run(part(walk.imu, 0, cut)), live.finish(), live.run(late), live.finish()])
    read = joined([offline.run(part(walk.imu, 0, cut)), offline.run(late), offline.finish()])
    np.testing.assert_array_equal(heard.stance, read.stance)
