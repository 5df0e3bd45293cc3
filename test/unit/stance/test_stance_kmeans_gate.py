from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pdr_core.params import DetectorParams
from pdr_core.records import joined, length, part
from pdr_core.stance.kmeans_gate import KmeansGate, shortest_true_s
from support.verdicts import span_of, verdicts

LONG_REST, DIP = (10.0, True), (0.03, True)
STRIDE = ((0.2, False), DIP, (0.4, False), (0.4, True))
WALK = (LONG_REST, *STRIDE * 12)
RUN = (LONG_REST, *STRIDE * 12, *((0.55, False), (0.03, True)) * 12)
BLOCK = verdicts(*RUN)


def gated(*spans, known=None):
    return KmeansGate(DetectorParams(), known).run(verdicts(*spans), final=True).stance


def dips(found, *spans):
    return [bool(found[span_of(4 * stride + 2, *spans)].any()) for stride in range(12)]


def without_dips(spans):
    expected = verdicts(*spans).stance.copy()
    for at, span in enumerate(spans[:49]):
        if span == DIP:
            expected[span_of(at, *spans)] = False
    return expected


def test_once_it_has_seen_some_phases_it_drops_the_dips_and_keeps_the_stances():
    found = gated(*WALK)
    assert dips(found, *WALK) == [True] * 4 + [False] * 8
    kept = found | without_dips(WALK) == found
    assert kept.all()


def test_with_the_phases_known_beforehand_it_drops_them_all():
    found = gated(*WALK, known=np.array([0.03, 0.4] * 12))
    np.testing.assert_array_equal(found, without_dips(WALK))


def test_the_short_stances_of_a_run_are_kept_by_what_a_walk_has_taught():
    np.testing.assert_array_equal(gated(*RUN, known=np.array([0.03, 0.4] * 12)), without_dips(RUN))


@pytest.mark.parametrize("pause_s", [2.0, 60.0, 3600.0])
def test_long_pauses_do_not_become_the_only_true_cluster(pause_s):
    phases_s = np.array([pause_s, 0.03, 0.4, 0.03, 0.45, 0.02, 0.38, 0.04, pause_s, 0.4])
    assert shortest_true_s(phases_s) == pytest.approx(np.sqrt(0.04 * 0.38))


@pytest.mark.parametrize(
    "phases_s", [[0.4] * 20, [0.3, 0.35, 0.4, 0.5, 0.55, 0.6, 0.7, 0.8], [0.03, 0.4, 0.03], []], ids=len
)
def test_where_there_are_no_two_clusters_all_are_true(phases_s):
    assert shortest_true_s(np.array(phases_s)) == 0.0


def test_a_rest_that_lasts_is_never_locked_out():
    teaching = np.array([0.2, 2.0] * 10)  # a limit of .45 s, if it were not for the longest one
    spans = ((1.0, True), (0.2, False), (0.11, True), (0.2, False), (0.09, True), (0.1, False))
    found = gated(*spans, known=teaching)
    assert found[span_of(2, *spans)].all()
    assert not found[span_of(4, *spans)].any()


@given(cuts=st.lists(st.integers(0, len(BLOCK.stance)), max_size=8))
@settings(max_examples=20)
def test_what_it_learns_does_not_depend_on_where_the_stream_is_cut(cuts):
    gate, ends = KmeansGate(DetectorParams()), [0, *sorted(cuts), len(BLOCK.stance)]
    pieces = [gate.run(part(BLOCK, a, b), final=False) for a, b in pairwise(ends)]
    found = joined([*pieces, gate.run(part(BLOCK, 0, 0), final=True)])
    np.testing.assert_array_equal(found.stance, gated(*RUN))
    np.testing.assert_array_equal(found.imu.stamp_ns, BLOCK.imu.stamp_ns)


def test_the_first_rest_is_no_cluster_of_its_own():
    spans = (LONG_REST, *((0.2, False), (0.05, True)) * 20)  # tapping: short stances in quick succession
    np.testing.assert_array_equal(gated(*spans), verdicts(*spans).stance)


def test_a_phase_that_is_too_short_is_known_within_the_latency():
    gate, known, waited_ns = KmeansGate(DetectorParams()), 0, 0
    for i in range(len(BLOCK.stance)):
        known += length(gate.run(part(BLOCK, i, i + 1), final=False))
        if known <= i:
            waited_ns = max(waited_ns, BLOCK.imu.stamp_ns[i] - BLOCK.imu.stamp_ns[known])
    assert 0 < waited_ns <= gate.latency_s * 1e9


def test_a_phase_that_a_gap_cuts_short_teaches_nothing():
    gate, at = KmeansGate(DetectorParams()), 10**18
    for seconds in (0.02, 0.4) * 8:
        piece = verdicts((0.05, False), (seconds, True), start_ns=at)
        gate.run(piece, final=False)
        at = int(piece.imu.stamp_ns[-1]) + 500_000_000
    spans = ((0.4, True), (0.2, False), DIP, (0.2, False))
    found = gate.run(verdicts(*spans, start_ns=at), final=True)
    np.testing.assert_array_equal(found.stance, verdicts(*spans).stance)
