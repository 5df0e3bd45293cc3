"""Every kind of dirty stamp: exactly which samples come out, exactly what is said, and a track that stays finite."""

import numpy as np
import pytest

from pdr_core.intake.stamp_policy import StampPolicy
from pdr_core.params import IntakeParams, Params, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import Level, joined, length, part
from support.walks import straight_walk

MS, S = 1_000_000, 1_000_000_000
PERIOD_NS = 5 * MS
CLEAN = straight_walk(2, 200.0).imu
N = length(CLEAN)
WALK = CLEAN._replace(gyro_sd_radps=np.arange(N, dtype=float))  # so that each sample can be told from the others
AT = CLEAN.stamp_ns
ALL, K = np.arange(N), N // 2 + 50  # K: in the swing of a stride
SAID = {
    "duplicate_stamp": (Level.WARN, "samples repeat the one before them, stamp and values: left out"),
    "equal_stamps": (
        Level.WARN,
        "different samples have one stamp, only the first is used: "
        "stamp by the sensor's clock or set intake.constant_rate_hz",
    ),
    "no_stamp": (Level.ERROR, "stamps are zero, only the first sample is used: let the driver stamp"),
    "late_stamp": (Level.WARN, "samples come after younger ones, left out: let one driver send, in order"),
    "stray_stamp": (Level.WARN, "single stamps are far off all others, left out: check the driver"),
    "burst": (
        Level.WARN,
        "samples wait and then come at once, stamped on arrival: "
        "stamp by the sensor's clock or set intake.constant_rate_hz",
    ),
    "gap": (Level.WARN, "samples are missing, the position is uncertain after the gap: check the link"),
    "clock_jumped_back": (Level.WARN, "the stamps jump back: the track goes on from where it was"),
    "clock_jumped_forth": (
        Level.WARN,
        "the stamps jump ahead, a clock was set or the sensor slept: the track goes on from where it was",
    ),
    "constant_rate": (Level.WARN, "the samples do not come at intake.constant_rate_hz: set it to the sensor's rate"),
}


def moved(by_ns, start, stop=N, every=1):
    """The stamps, but those of some rows moved."""
    stamps = AT.copy()
    stamps[start:stop:every] += by_ns
    return stamps


def at_once(start, stop, apart_ns):
    """The stamps, but some samples wait for the last of them and are stamped then."""
    stamps = AT.copy()
    stamps[start:stop] = stamps[stop - 1] + np.arange(stop - start) * apart_ns
    return stamps


def in_batches(of, apart_ns=0):
    """The stamps of samples that all come in batches and are stamped then."""
    return AT[0] + (ALL // of + 1) * of * PERIOD_NS + ALL % of * apart_ns


def replaced(start, *values):
    stamps = AT.copy()
    stamps[start : start + len(values)] = values
    return stamps


def without(*rows):
    return np.delete(ALL, np.r_[rows])


JITTER_NS = (np.random.default_rng(1).uniform(-0.4, 0.4, N) * PERIOD_NS).astype(np.int64)
YEARS_NS = 315_576_000 * S
# name: (stamps, which samples come out, {kind: (count, first stamp)})
DIRTY = {
    "clean": (AT, ALL, {}),
    "negative": (AT - AT[K], ALL, {}),
    "jitter": (AT + JITTER_NS, ALL, {}),
    "zero": (0 * AT, [0], {"no_stamp": (N - 1, 0)}),
    "all the same": (0 * AT + S, [0], {"equal_stamps": (N - 1, S)}),
    "zero for a while": (
        replaced(K, *[0] * 10),
        without(slice(K, K + 10)),
        {"stray_stamp": (1, 0), "no_stamp": (9, 0)},
    ),
    "swapped pair": (replaced(K, AT[K + 1], AT[K]), np.r_[:K, K + 1, K, K + 2 : N], {}),
    "late": (moved(-35 * MS, K, K + 1), without(K), {"late_stamp": (1, AT[K - 7])}),
    "set back a little": (moved(-102 * MS, K), without(slice(K, K + 20)), {"late_stamp": (20, AT[K] - 102 * MS)}),
    "ten with one stamp": (
        at_once(K, K + 10, 0),
        without(slice(K + 1, K + 10)),
        {"equal_stamps": (9, AT[K + 9])},
    ),
    "ten nearly at once": (at_once(K, K + 10, MS // 20), ALL, {"burst": (1, AT[K + 9] + MS // 10)}),
    "batches with one stamp": (in_batches(10), ALL[::10], {"equal_stamps": (N - N // 10, AT[10])}),
    "batches nearly at once": (in_batches(10, MS // 20), ALL, {"burst": (N // 10 - 2, AT[30] + MS // 10)}),
    "a second is missing": (moved(S, K), ALL, {"gap": (1, AT[K] + S)}),
    "a minute is missing": (moved(59 * S, K), ALL, {"gap": (1, AT[K] + 59 * S)}),
    "set an hour ahead": (moved(3600 * S, K), ALL, {"clock_jumped_forth": (1, AT[K] + 3600 * S)}),
    "set ten years ahead": (moved(YEARS_NS, K), ALL, {"clock_jumped_forth": (1, AT[K] + YEARS_NS)}),
    "set ten seconds back": (moved(-10 * S, K), ALL, {"clock_jumped_back": (1, AT[K] - 10 * S)}),
    "the last one jumps": (moved(-10 * S, N - 1), ALL, {"clock_jumped_back": (1, AT[-1] - 10 * S)}),
    "stray far ahead": (moved(3600 * S, K, K + 1), without(K), {"stray_stamp": (1, AT[K] + 3600 * S)}),
    "stray ahead": (moved(S // 2, K, K + 1), without(K), {"stray_stamp": (1, AT[K] + S // 2)}),
    "stray far back": (moved(-3600 * S, K, K + 1), without(K), {"stray_stamp": (1, AT[K] - 3600 * S)}),
    "stray back": (moved(-2 * S, K, K + 1), without(K), {"stray_stamp": (1, AT[K] - 2 * S)}),
    "stray at the jump": (
        moved(-10 * S, K) + np.where(ALL == K, 3600 * S, 0),
        without(K),
        {"stray_stamp": (1, AT[K] + 3590 * S), "clock_jumped_back": (1, AT[K + 1] - 10 * S)},
    ),
    "late at the jump": (
        moved(-10 * S, K) + np.where(ALL == K, 12 * MS, 0),
        without(K + 1, K + 2),
        {"clock_jumped_back": (1, AT[K] - 10 * S + 12 * MS), "late_stamp": (2, AT[K + 1] - 10 * S)},
    ),
    "two clocks in turn": (
        moved(-3600 * S, K, K + 20, 2),
        without(slice(K, K + 20, 2)),
        {"stray_stamp": (10, AT[K] - 3600 * S)},
    ),
    "no clock shows this": (
        replaced(0, 2**62, 2**62 + 5 * MS, -(2**62), -(2**63)),
        without(slice(0, 4)),
        {"stray_stamp": (4, 2**62)},
    ),
}


def through(policy, imu):
    """What comes out, and how often what was said of it; every text is the one for its kind."""
    out = joined([policy.run(imu), policy.finish()])
    assert {n.kind: (n.level, n.text) for n in policy.notices} == {n.kind: SAID[n.kind] for n in policy.notices}
    return out, {n.kind: (n.count, n.first_stamp_ns) for n in policy.notices}


def assert_samples(out, imu, rows):
    """Samples `rows` came out, in this order, with their own values."""
    assert out.gyro_sd_radps.tolist() == list(rows)
    for found, known in zip(out[1:], imu[1:], strict=True):
        np.testing.assert_array_equal(found, known[rows])


@pytest.mark.parametrize("name", DIRTY)
def test_what_comes_out_and_what_is_said(name):
    stamps, rows, notices = DIRTY[name]
    out, said = through(StampPolicy(IntakeParams()), WALK._replace(stamp_ns=stamps))
    assert said == notices
    assert_samples(out, WALK, rows)
    np.testing.assert_array_equal(out.stamp_ns, stamps[rows])


@pytest.mark.parametrize("name", DIRTY)
def test_the_track_goes_on_through_it_and_stays_finite(name):
    stamps, rows, _ = DIRTY[name]
    chain = FootInertial(Params())
    outs = [chain.run(CLEAN._replace(stamp_ns=stamps)), chain.finish()]
    nav = joined([out.nav for out in outs])
    np.testing.assert_array_equal(nav.stamp_ns, stamps[rows])
    assert all(np.isfinite(column).all() for column in nav)


@pytest.mark.parametrize("rate_hz", [0.0, 200.0])
def test_repeated_samples_are_left_out(rate_hz):
    rows = np.sort(np.r_[ALL, K, K, K + 1])
    out, said = through(StampPolicy(IntakeParams(constant_rate_hz=rate_hz)), part_of(WALK, rows))
    assert said == {"duplicate_stamp": (3, AT[K])}
    assert_samples(out, WALK, ALL)


def part_of(imu, rows):
    return imu._replace(**{name: column[rows] for name, column in imu._asdict().items()})


@pytest.mark.parametrize(("back_s", "kind"), [(0.902, "late_stamp"), (1.102, "clock_jumped_back")])
def test_what_is_a_restart_is_a_parameter(back_s, kind):
    stamps = moved(-round(back_s * S), K)
    assert list(through(StampPolicy(IntakeParams()), WALK._replace(stamp_ns=stamps))[1]) == [kind]
    far = StampPolicy(IntakeParams(restart_s=2.0))
    assert list(through(far, WALK._replace(stamp_ns=stamps))[1]) == ["late_stamp"]


@pytest.mark.parametrize(("missing_ms", "gaps"), [(100, 0), (101, 1)])
def test_a_gap_begins_at_a_tenth_of_a_second(missing_ms, gaps):
    _, said = through(StampPolicy(IntakeParams()), WALK._replace(stamp_ns=moved((missing_ms - 5) * MS, K)))
    assert len(said) == gaps


def test_a_sample_waits_only_where_its_stamp_is_not_the_next():
    imu, policy = WALK._replace(stamp_ns=moved(S, K)), StampPolicy(IntakeParams())
    counts = [length(policy.run(part(imu, i, i + 1))) for i in range(N)]
    assert counts[K : K + 2] == [0, 2]
    assert np.all(np.delete(counts, [K, K + 1]) == 1)


@pytest.mark.parametrize("apart_ns", [0, MS // 20])
def test_batches_get_even_stamps(apart_ns):
    out, said = through(
        StampPolicy(IntakeParams(constant_rate_hz=200.0)), WALK._replace(stamp_ns=in_batches(10, apart_ns))
    )
    assert said == {}
    assert_samples(out, WALK, ALL)
    interval_ns = np.diff(out.stamp_ns)
    assert np.all(abs(interval_ns - PERIOD_NS) < 0.11 * PERIOD_NS)
    assert abs(out.stamp_ns - AT)[N // 2 :].max() < 50 * MS  # a batch


def test_a_clock_that_runs_a_little_faster_is_followed():
    fast = WALK._replace(stamp_ns=AT[0] + (AT - AT[0]) * 98 // 100)
    out, said = through(StampPolicy(IntakeParams(constant_rate_hz=200.0)), fast)
    assert said == {}
    np.testing.assert_allclose(np.diff(out.stamp_ns)[N // 2 :], 0.98 * PERIOD_NS, rtol=1e-3)
    assert abs(out.stamp_ns - fast.stamp_ns).max() < 10.5 * MS


@pytest.mark.parametrize(("rate_hz", "kept"), [(100.0, 0.6), (400.0, 1.0)])
def test_a_wrong_rate_is_told(rate_hz, kept):
    out, said = through(StampPolicy(IntakeParams(constant_rate_hz=rate_hz)), WALK)
    assert list(said) == ["constant_rate"]
    assert length(out) / N == pytest.approx(kept, abs=0.1)
    assert np.all(np.diff(out.stamp_ns) > 0)
    assert abs(out.stamp_ns - AT[out.gyro_sd_radps.astype(int)]).max() <= 100 * MS


JUMPS = ("a second is missing", "set an hour ahead", "set ten seconds back", "swapped pair", "stray back", "late")


@pytest.mark.parametrize("name", JUMPS)
def test_gaps_and_jumps_stay_where_stamps_are_even(name):
    stamps, rows, notices = DIRTY[name]
    out, said = through(StampPolicy(IntakeParams(constant_rate_hz=200.0)), WALK._replace(stamp_ns=stamps))
    assert said == notices
    assert_samples(out, WALK, rows)
    np.testing.assert_allclose(out.stamp_ns - stamps[rows], 0, atol=PERIOD_NS)


def test_a_walk_in_batches_is_as_long_as_ever():
    chain = FootInertial(changed(Params(), "intake", constant_rate_hz=200.0))
    outs = [chain.run(CLEAN._replace(stamp_ns=in_batches(10))), chain.finish()]
    assert not chain.notices
    assert sum(len(out.steps) for out in outs) == 2
    assert outs[-1].nav.position_m[-1, 0] == pytest.approx(2.4, rel=0.05)
