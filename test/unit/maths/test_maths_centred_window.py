import numpy as np
import pytest

from pdr_core.conventions import GAP_NS
from pdr_core.maths.centred_window import centred_windows

MS = 1_000_000
STAMPS = np.arange(20, dtype=np.int64) * 5 * MS


def test_a_window_holds_what_is_near_on_both_sides():
    firsts, lasts = centred_windows(STAMPS, 3, 18, 12 * MS)
    np.testing.assert_array_equal(firsts, np.maximum(0, np.arange(3, 18) - 2))
    np.testing.assert_array_equal(lasts, np.minimum(20, np.arange(3, 18) + 3))


@pytest.mark.parametrize("half_ns", [0, MS, 4 * MS])
def test_a_window_that_is_short_beside_the_interval_holds_the_neighbours(half_ns):
    firsts, lasts = centred_windows(STAMPS, 0, 20, half_ns)
    np.testing.assert_array_equal(firsts, np.maximum(0, np.arange(20) - 1))
    np.testing.assert_array_equal(lasts, np.minimum(20, np.arange(20) + 2))


def test_a_sample_beyond_a_gap_is_no_neighbour():
    stamps = STAMPS.copy()
    stamps[10:] += GAP_NS
    firsts, lasts = centred_windows(stamps, 0, 20, MS)
    assert (firsts[10], lasts[9]) == (10, 10)
    assert (firsts[9], lasts[10]) == (8, 12)
