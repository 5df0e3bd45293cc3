"""Each sample gets the field nearest to it, whichever stream is ahead, and no sample is lost."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pdr_core.field_pairing import FieldPairing
from pdr_core.records import Level, inertial_block, joined, length, part

STEP_NS, WAIT_NS = 5_000_000, 50_000_000


def samples(stamp_ns):
    """Samples that are told apart by their rate."""
    n = len(stamp_ns)
    gyro = np.arange(3.0 * n).reshape(n, 3)
    return inertial_block(np.asarray(stamp_ns, np.int64), gyro, -gyro, np.zeros(n), np.zeros(n))


def put(pairing, stamp_ns, sd=0.0):
    """Measure fields whose x axis tells their stamp."""
    stamp_ns = np.asarray(stamp_ns, np.int64)
    field = np.column_stack([stamp_ns, np.ones((len(stamp_ns), 2))]).astype(np.float64)
    pairing.take_field(stamp_ns, field, np.full(len(stamp_ns), sd))


def taken(block):
    """The stamp of the field that each sample has, None where there is none."""
    there = zip(block.field_tesla[:, 0], block.field_sd_tesla, strict=True)
    return [int(x) if sd >= 0.0 else None for x, sd in there]


def expected(sample_ns, field_ns, reach_ns):
    """Every pair by brute force: the field's nearest sample, and of its fields the nearest."""
    found = {}
    for f in field_ns:
        s = min(sample_ns, key=lambda s: (abs(s - f), s))
        if abs(s - f) <= reach_ns(s):
            found[s] = min(found.get(s, f), f, key=lambda g: (abs(g - s), g))
    return [found.get(s) for s in sample_ns]


def arrive(pairing, arrivals):
    """Run ('imu' or 'mag', stamp) one by one; return all samples."""
    out = []
    for stream, stamp_ns in arrivals:
        if stream == "mag":
            put(pairing, [stamp_ns])
        else:
            out.append(pairing.run(samples([stamp_ns])))
    return joined([*out, pairing.finish()])


def usual(sample_ns):
    """Half the usual interval at each sample, for regular samples."""
    return lambda s: 0 if s == sample_ns[0] else STEP_NS // 2


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


def test_an_explicit_none_releases_its_sample_at_once():
    pairing = FieldPairing(WAIT_NS)
    assert length(pairing.run(samples([0]))) == 0
    put(pairing, [0], sd=-1.0)
    out = pairing.run(samples([STEP_NS]))
    assert (out.stamp_ns.tolist(), taken(out), out.field_tesla.any()) == ([0], [None], False)


def test_a_field_that_is_no_number_is_none():
    pairing = FieldPairing(WAIT_NS)
    pairing.take_field(np.array([0]), np.array([[1.0, np.nan, 1.0]]), np.zeros(1))
    out = pairing.run(samples([0]))
    assert (out.field_sd_tesla.tolist(), out.field_tesla.tolist()) == ([-1.0], [[0.0, 0.0, 0.0]])


def test_what_a_sample_carries_stays_unless_a_field_is_paired_to_it():
    pairing = FieldPairing(WAIT_NS)
    carried = samples([0, STEP_NS])._replace(field_tesla=np.full((2, 3), 7.0), field_sd_tesla=np.full(2, 0.5))
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


def test_no_field_delays_the_samples_by_the_wait_only():
    pairing = FieldPairing(WAIT_NS)
    for i in range(100):
        pairing.run(samples([i * STEP_NS]))
        assert length(pairing._waiting) <= 10
    assert pairing.notices == []


def test_a_field_that_comes_too_late_is_told():
    pairing = FieldPairing(WAIT_NS)
    for i in range(200):
        pairing.run(samples([i * STEP_NS]))
        if i >= 20:
            put(pairing, [(i - 20) * STEP_NS])
    told = {n.kind: n for n in pairing.notices}
    assert set(told) == {"field_late"}
    assert told["field_late"].count > 100
    assert told["field_late"].level is Level.WARN


def test_fields_of_another_clock_are_told():
    pairing = FieldPairing(WAIT_NS)
    for i in range(600):
        put(pairing, [10**18 + i * STEP_NS])
        pairing.run(samples([i * STEP_NS]))
    assert [(n.kind, n.count) for n in pairing.notices] == [("field_silent", 1)]


@pytest.mark.parametrize("size", [1, 13, 2000])
def test_each_silence_of_the_magnetometer_is_told_once_and_a_gap_is_none(size):
    sample_ns = [t * STEP_NS for t in (*range(1000), *range(2000, 3000))]
    pairing = FieldPairing(WAIT_NS)
    put(pairing, [s for i, s in enumerate(sample_ns) if not (200 < i < 500 or 1200 < i < 1500)])
    for i in range(0, 2000, size):
        pairing.run(samples(sample_ns[i : i + size]))
    (notice,) = pairing.notices
    assert (notice.kind, notice.count) == ("field_silent", 2)


def test_surplus_fields_are_counted_but_no_warning():
    pairing = FieldPairing(WAIT_NS)
    for i in range(400):
        put(pairing, [i * STEP_NS, i * STEP_NS + 2_500_000])
        pairing.run(samples([i * STEP_NS]))
    (notice,) = pairing.notices
    assert (notice.kind, notice.level) == ("field_unpaired", Level.OK)
    assert notice.count > 350


def test_fields_without_samples_are_not_held_without_bound():
    pairing = FieldPairing(WAIT_NS)
    for i in range(0, 600_000, 5000):
        put(pairing, [(i + k) * STEP_NS for k in range(5000)])
    pairing.run(samples([600_000 * STEP_NS]))
    assert length(pairing._store._fields) <= 500_000
