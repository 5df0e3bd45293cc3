"""The stress test as the command runs it: five hundred walks. `-s` shows the figures."""

import os

import pytest

from pdr_core.bench.stress import stress, summary


@pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")
def test_no_walk_of_five_hundred_fails() -> None:
    results = stress(range(500))
    for row in summary(results):
        print(f"\n{row.kind:<20}{row.failed} of {row.walks} failed, {row.median_percent:.2f} % median", end="")
        print(f", {row.high_percent:.2f} % at the 95th percentile, {row.worst_percent:.2f} % worst", end="")
    assert [(r.drawn.seed, r.ate2_percent, r.drawn.text) for r in results if r.failed] == []
