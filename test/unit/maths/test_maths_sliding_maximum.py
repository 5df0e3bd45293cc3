import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.maths import sliding_maximum
from pdr_core.maths.sliding_maximum import fresh_maximum, push_maximum


@given(st.lists(st.tuples(st.integers(1, 50), st.integers(0, 9)), min_size=1, max_size=200), st.integers(0, 200))
def test_it_is_the_largest_of_the_window(steps, window_ns):
    stamps, values, state = np.cumsum([s for s, _ in steps]), np.array([float(v) for _, v in steps]), fresh_maximum()
    for i in range(len(steps)):
        inside = (stamps[: i + 1] >= stamps[i] - window_ns) & (stamps[: i + 1] <= stamps[i])
        assert push_maximum(stamps[i], values[i], window_ns, state) == values[: i + 1][inside].max()


def test_where_it_overflows_the_oldest_is_forgotten():
    state, n = fresh_maximum(), sliding_maximum.CAPACITY + 100
    found = [push_maximum(i, float(n - i), 10**9, state) for i in range(n)]
    assert found[sliding_maximum.CAPACITY - 1] == n
    assert found[-1] == n - 100
