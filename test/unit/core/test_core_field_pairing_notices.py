"""What is said of fields that are late, missing or too many, and how much is held."""

import pytest
from field_pairing_cases import STEP_NS, WAIT_NS, put, samples

from pdr_core.field_pairing import FieldPairing
from pdr_core.records import Level, length


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
    put(pairing, [s for i, s in enumerate(sample_ns) if not (200 < i < 500 or 950 < i < 1100 or 1200 < i < 1500)])
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
