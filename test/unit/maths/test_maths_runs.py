"""Runs of equal values."""

import numpy as np
import pytest

from pdr_core.maths.runs import equal_runs


@pytest.mark.parametrize(
    ("values", "runs"),
    [
        ([], []),
        ([True], [(0, 1)]),
        ([False, False, True, True, False], [(0, 2), (2, 4), (4, 5)]),
        ([1.0, 1.0, 0.5, -1.0], [(0, 2), (2, 3), (3, 4)]),
    ],
)
def test_runs_cover_all_rows_in_order(values, runs):
    assert equal_runs(np.array(values)) == runs
