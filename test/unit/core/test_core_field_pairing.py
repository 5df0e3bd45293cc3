"""Each sample gets the field nearest to it, whichever stream is ahead, and no sample waits longer than it must."""

import numpy as np
import pytest
from field_pairing_cases import STEP_NS, WAIT_NS, arrive, expected, put, samples, taken, usual
from hypothesis import given, settings
from hypothesis import strategies as st

from pdr_core.conventions import GAP_NS
from pdr_core.field_pairing import FieldPairing
from pdr_core.records import joined, length


def test_fields_of_the_same_stamps_are_given_out_at_once():
    pairing = FieldPairing(WAIT_NS)
    for i in range(20):
        put(pairing, [i * STEP_NS], sd=2.0)
        out = pairing.run(samples([i * STEP_NS]))
        assert (taken(out), out.field_sd_tesla.tolist()) == ([i * STEP_NS], [2.0])
    assert pairing.notices == []


def test_a_sample_waits_for_its_field_and_no_longer():
    pairing = FieldPairing(WAIT_NS)
    for i in range(20):
        assert length(pairing.run(samples([i * STEP_NS]))) == 0 or i >= 10
    assert pairing._waiting.stamp_ns.tolist() == [i * STEP_NS for i in range(10, 20)]
    put(pairing, [12 * STEP_NS])
    out = pairing.run(samples([20 * STEP_NS]))
    assert out.stamp_ns.tolist() == [10 * STEP_NS, 11 * STEP_NS, 12 * STEP_NS]
    assert taken(out) == [None, None, 12 * STEP_NS]


def test_a_field_that_has_come_releases_its_sample_before_the_next_one():
    pairing = FieldPairing(WAIT_NS)
    assert length(pairing.run(samples([0]))) == 0
    put(pairing, [0])
    assert taken(pairing.run(samples([]))) == [0]
    assert length(pairing.run(samples([]))) == length(pairing.finish()) == 0


def test_an_explicit_none_releases_its_sample_at_once():
    pairing = FieldPairing(WAIT_NS)
    assert length(pairing.run(samples([0]))) == 0
    put(pairing, [0], sd=-1.0)
    out = pairing.run(samples([]))
    assert (out.stamp_ns.tolist(), taken(out), out.field_tesla.any()) == ([0], [None], False)


def test_a_field_that_is_no_number_is_none():
    pairing = FieldPairing(WAIT_NS)
    pairing.take_field(np.array([0]), np.array([[1.0, np.nan, 1.0]]), np.zeros(1))
    out = pairing.run(samples([0]))
    assert (out.field_sd_tesla.tolist(), out.field_tesla.tolist()) == ([-1.0], [[0.0, 0.0, 0.0]])


def test_what_a_sample_carries_stays_unless_a_field_is_paired_to_it():
    pairing = FieldPairing(WAIT_NS)
    carried = samples([0, STEP_NS])._replace(field_tesla=np.full((2, 3), 7.0), field_sd_tesla=np.full(2, 0.5))
    put(pairing, [0], sd=-1.0)
    put(pairing, [STEP_NS])
    out = joined([pairing.run(carried), pairing.finish()])
    assert out.field_tesla[:, 0].tolist() == [7.0, STEP_NS]
    assert out.field_sd_tesla.tolist() == [0.5, 0.0]
    assert carried.field_tesla[1, 0] == 7.0, "what came in is not written to"


@pytest.mark.parametrize("mag_hz", [10, 37, 100, 199, 450])
@pytest.mark.parametrize("offset_ns", [0, 1_234_567])
@pytest.mark.parametrize("size", [1, 7, 1000])
def test_other_rates_pair_with_the_nearest(mag_hz, offset_ns, size):
    sample_ns = [i * STEP_NS for i in range(300)]
    field_ns = [offset_ns + i * 10**9 // mag_hz for i in range(mag_hz * 3 // 2)]
    pairing = FieldPairing(WAIT_NS)
    put(pairing, field_ns)
    out = [pairing.run(samples(sample_ns[i : i + size])) for i in range(0, 300, size)]
    out = joined([*out, pairing.finish()])
    assert taken(out) == expected(sample_ns, field_ns, usual(sample_ns))
    assert sum(f is not None for f in taken(out)) >= min(mag_hz, 195) * 1.4
    assert "field_late" not in [n.kind for n in pairing.notices]


@given(st.integers(0, 10**6), st.sampled_from([0.2, 0.5, 1.0, 2.0]))
def test_uneven_samples_pair_as_the_rule_says(seed, fields_per_sample):
    rng = np.random.default_rng(seed)
    steps_ns = rng.integers(1, 2 * STEP_NS, 200)
    steps_ns[[50, 120]] = [GAP_NS + 1, 9 * GAP_NS]
    steps_ns[130:] *= 3
    sample_ns = np.cumsum(steps_ns).tolist()
    field_ns = np.unique(rng.integers(0, sample_ns[-1], int(200 * fields_per_sample)) // 1000 * 1000).tolist()
    pairing = FieldPairing(WAIT_NS)
    put(pairing, field_ns)
    out = joined([pairing.run(samples(sample_ns)), pairing.finish()])
    assert taken(out) == expected(sample_ns, field_ns, usual(sample_ns))


def test_a_field_ahead_waits_for_the_sample_that_may_be_nearer():
    pairing = FieldPairing(WAIT_NS)
    put(pairing, [0, STEP_NS, 2 * STEP_NS])
    assert length(pairing.run(samples([0, STEP_NS, 2 * STEP_NS]))) == 3
    at_ns = 3 * STEP_NS
    assert length(pairing.run(samples([at_ns]))) == 0
    put(pairing, [at_ns + 2_400_000])
    assert length(pairing.run(samples([]))) == 0
    assert taken(pairing.run(samples([at_ns + 4_000_000]))) == [None]
    assert taken(pairing.finish()) == [at_ns + 2_400_000]


def test_a_field_behind_waits_for_the_field_that_may_be_nearer():
    pairing = FieldPairing(WAIT_NS)
    put(pairing, [0, STEP_NS, 2 * STEP_NS - 1_000_000])
    assert length(pairing.run(samples([0, STEP_NS, 2 * STEP_NS]))) == 2
    put(pairing, [2 * STEP_NS + 600_000])
    assert taken(pairing.run(samples([3 * STEP_NS]))) == [2 * STEP_NS + 600_000]


@settings(max_examples=300)
@given(
    st.lists(st.integers(-2_400_000, 2_400_000), min_size=30, max_size=30),
    st.lists(st.integers(0, 150_000_000), max_size=40, unique=True),
    st.randoms(),
)
def test_the_order_of_arrival_changes_nothing(jitter, field_ns, random):
    sample_ns = [i * STEP_NS + j for i, j in enumerate(jitter)]
    at_once, one_by_one = FieldPairing(WAIT_NS), FieldPairing(WAIT_NS)
    put(at_once, sorted(field_ns))
    whole = joined([at_once.run(samples(sample_ns)), at_once.finish()])
    lag_ns = {"imu": random.randrange(WAIT_NS // 3), "mag": random.randrange(WAIT_NS // 3)}
    events = [("imu", s) for s in sample_ns] + [("mag", f) for f in sorted(field_ns)]
    delays = {}
    arrivals = []
    for stream, stamp_ns in events:  # each stream in its own order, and never late by more than the wait
        delays[stream] = max(delays.get(stream, 0), stamp_ns + lag_ns[stream] + random.randrange(WAIT_NS // 3))
        arrivals.append((delays[stream], stream, stamp_ns))
    shuffled = arrive(one_by_one, [(stream, stamp) for _, stream, stamp in sorted(arrivals, key=lambda a: a[0])])
    assert shuffled.stamp_ns.tolist() == whole.stamp_ns.tolist() == sample_ns
    assert taken(shuffled) == taken(whole)
