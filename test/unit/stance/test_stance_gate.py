import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.stance.gait_gate import GateLimits, decide, fresh_state

MS = 1_000_000
LIMITS = GateLimits(threshold=10.0, toe_off=40.0, stance_min_ns=50 * MS, dip_max_ns=150 * MS, swing_min_ns=550 * MS)
LOW, WOBBLE, SWING = 1.0, 20.0, 100.0


def spans(*pieces):
    """Return the statistic, a sample each 10 ms, of (milliseconds, value) pieces."""
    return np.concatenate([np.full(ms // 10, value) for ms, value in pieces])


def verdicts(statistic, final=True, begin_ns=10**18):
    stamps = begin_ns + np.arange(len(statistic)) * 10 * MS
    verdict = np.empty(len(statistic), bool)
    count = decide(stamps, statistic, LIMITS, fresh_state(), final, verdict)
    return verdict[:count]


def standing_ms(*pieces):
    """Return for each piece how many milliseconds of it are stance."""
    verdict, out = verdicts(spans(*pieces)), []
    for ms, _ in pieces:
        out.append(int(verdict[: ms // 10].sum()) * 10)
        verdict = verdict[ms // 10 :]
    return out


def test_a_stance_is_all_of_its_run():
    assert standing_ms((500, LOW), (500, SWING), (300, LOW), (100, SWING)) == [500, 0, 300, 0]


@pytest.mark.parametrize(("ms", "stands"), [(50, 0), (60, 60)])
def test_the_time_threshold(ms, stands):
    assert standing_ms((100, WOBBLE), (ms, LOW), (100, WOBBLE))[1] == stands  # n samples last n - 1 intervals


@pytest.mark.parametrize(("ms", "stands"), [(60, 0), (150, 0), (160, 160)])
def test_a_dip_soon_after_toe_off_must_last_longer(ms, stands):
    assert standing_ms((500, LOW), (200, SWING), (ms, LOW), (200, SWING), (500, LOW)) == [500, 0, stands, 0, 500]


def test_a_short_stance_long_after_toe_off_is_one():
    assert standing_ms((500, LOW), (560, SWING), (60, LOW), (200, SWING)) == [500, 0, 60, 0]


def test_a_wobble_is_no_toe_off():
    assert standing_ms((500, LOW), (200, WOBBLE), (60, LOW), (200, WOBBLE)) == [500, 0, 60, 0]


def test_a_rejected_dip_does_not_end_the_swing():
    pieces = (500, LOW), (150, SWING), (100, LOW), (100, WOBBLE), (100, LOW), (300, SWING), (60, LOW), (50, SWING)
    assert standing_ms(*pieces) == [500, 0, 0, 0, 0, 0, 60, 0]


def test_the_threshold_itself_is_stance():
    assert verdicts(np.full(20, LIMITS.threshold)).all()


def test_an_unfinished_run_waits_and_is_rejected_at_the_end():
    statistic = spans((100, SWING), (40, LOW))
    assert len(verdicts(statistic, final=False)) == 10
    assert not verdicts(statistic, final=True).any()


@given(
    st.lists(st.tuples(st.integers(1, 40), st.sampled_from([LOW, WOBBLE, SWING])), min_size=1, max_size=12), st.data()
)
def test_verdicts_do_not_depend_on_how_the_stream_is_cut(pieces, data):
    statistic = spans(*((10 * n, value) for n, value in pieces))
    stamps, state, done, out = np.arange(len(statistic)) * 10 * MS, fresh_state(), 0, []
    while done < len(statistic):
        stop = data.draw(st.integers(done + 1, len(statistic)))
        verdict = np.empty(stop - done, bool)
        count = decide(stamps[done:stop], statistic[done:stop], LIMITS, state, False, verdict)
        out += verdict[:count].tolist()
        done += count
        if stop == len(statistic):
            break
    assert out == verdicts(statistic, final=False, begin_ns=0).tolist()
    longest_wait = LIMITS.dip_max_ns // (10 * MS)
    assert len(statistic) - done <= longest_wait
