"""Clocks that jump, stray, repeat or end: no sample is lost, and few fields."""

import numpy as np
import pytest
from field_pairing_cases import STEP_NS, WAIT_NS, arrive, put, samples, taken
from hypothesis import given, settings
from hypothesis import strategies as st

from pdr_core.field_pairing import FieldPairing
from pdr_core.records import joined, length, part


def test_stamps_at_both_ends_of_time_are_not_near():
    pairing = FieldPairing(WAIT_NS)
    assert pairing.run(samples([-(2**63), 2**63 - 1])).stamp_ns.tolist() == [-(2**63)]


def test_old_samples_do_not_wait_once_the_clock_of_the_field_has_jumped_back():
    pairing = FieldPairing(WAIT_NS)
    put(pairing, [10**9, 0])
    assert length(pairing.run(samples([10**9]))) == 1
    assert length(pairing.run(samples([10**9 + STEP_NS]))) == 1


@settings(max_examples=300)
@given(
    st.lists(st.integers(-(2**63), 2**63 - 1) | st.integers(0, 10**9), max_size=30),
    st.lists(st.integers(-(2**63), 2**63 - 1) | st.integers(0, 10**9), max_size=30),
    st.sampled_from([0, WAIT_NS]),
    st.randoms(),
)
def test_no_sample_is_lost_whatever_the_stamps(sample_ns, field_ns, wait_ns, random):
    pairing, out, left = FieldPairing(wait_ns), [], list(field_ns)
    block = samples(sample_ns)
    for i in range(len(sample_ns)):
        count = random.randrange(3)
        put(pairing, left[:count])
        left = left[count:]
        out.append(pairing.run(part(block, i, i + 1)))
    out = joined([part(block, 0, 0), *out, pairing.finish()])
    for column, before in zip(out[:5], block[:5], strict=True):
        np.testing.assert_array_equal(column, before)
    fields = [f for f in taken(out) if f is not None]
    assert all(fields.count(f) <= [float(g) for g in field_ns].count(float(f)) for f in fields)


@pytest.mark.parametrize("size", [1, 50])
def test_repeats_and_rows_that_go_back_take_fields_of_just_their_stamp(size):
    sample_ns = [0, 5, 10, 10, 10, 7, 15, 20, 25]
    sample_ns = [s * 1_000_000 for s in sample_ns]
    pairing, out = FieldPairing(WAIT_NS), []
    for i in range(0, 9, size):
        put(pairing, sample_ns[i : i + size])
        out.append(pairing.run(samples(sample_ns[i : i + size])))
    out = joined([*out, pairing.finish()])
    assert taken(out) == out.stamp_ns.tolist() == sample_ns


@pytest.mark.parametrize("mag_first", [True, False])
@pytest.mark.parametrize("lag", [0, 3, 9])
def test_a_clock_that_jumps_back_goes_on_pairing(mag_first, lag):
    sample_ns = [t * STEP_NS for t in (*range(1000, 1100), *range(200))]
    events = [("imu", s) for s in sample_ns], [("mag", s) for s in sample_ns]
    late, early = events if mag_first else events[::-1]
    arrivals = [e for i in range(300 + lag) for e in (*early[i : i + 1], *([late[i - lag]] if i >= lag else []))]
    out = arrive(FieldPairing(WAIT_NS), arrivals)
    assert out.stamp_ns.tolist() == sample_ns
    lost = [i for i, (f, s) in enumerate(zip(taken(out), sample_ns, strict=True)) if f != s]
    assert all(100 - lag <= i <= 100 for i in lost), lost


def test_a_block_may_hold_several_jumps():
    sample_ns = [t * STEP_NS for t in (*range(1000, 1100), *range(200), 10**6, *range(300, 400), -50, *range(400, 450))]
    pairing = FieldPairing(WAIT_NS)
    put(pairing, sample_ns)
    assert taken(joined([pairing.run(samples(sample_ns)), pairing.finish()])) == sample_ns


def test_one_stray_stamp_of_a_sample_costs_no_field_but_its_own():
    sample_ns = [t * STEP_NS for t in range(200)]
    for stray in (0, 10**17):
        pairing = FieldPairing(WAIT_NS)
        put(pairing, sample_ns)
        strayed = [*sample_ns[:100], stray, *sample_ns[101:]]
        out = joined([pairing.run(samples(strayed)), pairing.finish()])
        assert [i for i, f in enumerate(taken(out)) if f != sample_ns[i]] == [100]


@pytest.mark.parametrize("size", [1, 200, 5000])
@pytest.mark.parametrize("stray", [-(10**9), 10**17])
def test_one_stray_stamp_of_a_field_costs_a_few_fields(stray, size):
    sample_ns = [t * STEP_NS for t in range(5000)]
    field_ns = [*sample_ns[:100], stray, *sample_ns[101:]]
    pairing, out = FieldPairing(WAIT_NS), []
    for i in range(0, 5000, size):
        put(pairing, field_ns[i : i + size])
        out.append(pairing.run(samples(sample_ns[i : i + size])))
    lost = [i for i, f in enumerate(taken(joined([*out, pairing.finish()]))) if f != sample_ns[i]]
    assert lost[0] == 100
    assert lost[-1] < 106
    assert [n.kind for n in pairing.notices][:1] == ["field_clock"]
