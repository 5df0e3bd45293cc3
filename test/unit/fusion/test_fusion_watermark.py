"""Two feet merge by their stamps: the same order out, whatever the order in."""

from hypothesis import given
from hypothesis import strategies as st

from pdr_core.fusion import Watermark

STAMPS = st.lists(st.integers(0, 50), unique=True).map(sorted)


def merged(arrivals):
    """Put (stream, stamp) pairs in and return all that comes out, the rest at the end."""
    merge = Watermark(["left", "right"])
    out = [given for stream, stamp in arrivals for given in merge.put(stream, stamp, stamp)]
    return out, merge.finish()


@given(STAMPS, STAMPS, st.randoms())
def test_the_order_of_arrival_does_not_matter(left, right, random):
    arrivals = []
    queues = {"left": list(left), "right": list(right)}
    while any(queues.values()):
        stream = random.choice([name for name, queue in queues.items() if queue])
        arrivals.append((stream, queues[stream].pop(0)))
    out, rest = merged(arrivals)
    assert out + rest == sorted([("left", s) for s in left] + [("right", s) for s in right], key=lambda e: (e[1], e[0]))


def test_nothing_is_given_out_before_the_other_foot_has_passed_it():
    merge = Watermark(["left", "right"])
    assert merge.put("left", 10, "a") == []
    assert merge.put("right", 7, "b") == [("right", "b")]
    assert merge.put("right", 12, "c") == [("left", "a")]
    assert merge.advance("left", 12) == [("right", "c")]


def test_equal_stamps_keep_the_order_of_the_names():
    assert merged([("right", 5), ("left", 5)])[0] == [("left", 5), ("right", 5)]


def test_a_foot_that_has_left_holds_nothing_back_until_it_returns():
    merge = Watermark(["left", "right"])
    assert merge.put("left", 10, "a") == []
    assert merge.leave("right") == [("left", "a")]
    assert merge.put("left", 20, "b") == [("left", "b")]
    assert merge.put("right", 25, "c") == []
    assert merge.put("left", 30, "d") == [("right", "c")]


def test_a_clock_that_jumps_back_locks_nothing():
    merge = Watermark(["left", "right"])
    merge.put("left", 100, "a")
    assert merge.put("left", 3, "b") == [("left", "a")]
    assert merge.put("right", 4, "c") == [("left", "b")]
