import math
from dataclasses import replace

import numpy as np
import pytest

from pdr_core.evaluation.score import Scorer
from pdr_core.evaluation.walk_score import summary, walk_score
from pdr_core.records import Truth, TruthKind

NO_STAMPS = np.empty(0, dtype=np.int64)


@pytest.fixture(scope="module")
def scores(make):
    """The walk round the rectangle against each kind of truth."""
    walk = make.rectangle()
    truths = {
        "none": None,
        "position": Truth(TruthKind.POSITION, walk.stamp_ns, walk.true_m),
        "strides": Truth(TruthKind.STRIDES, NO_STAMPS, walk.footfall_m),
        "closed_loop": Truth(TruthKind.CLOSED_LOOP, NO_STAMPS, np.empty((0, 3))),
    }
    found = {}
    for kind, truth in truths.items():
        scorer = Scorer(truth)
        scorer.add(walk.nav)
        found[kind] = walk_score(scorer, walk.steps, walk.judged.stance)
        assert found[kind].truth == kind
    return found


def test_each_truth_tells_what_it_can(scores):
    known = {
        kind: {name for name, x in vars(score).items() if name.endswith("_m") and not math.isnan(x)}
        for kind, score in scores.items()
    }
    ends = {"closure_2d_m", "closure_3d_m"}
    assert known == {
        "none": ends, "position": {"ate2_m", "ate3_m"}, "strides": {"stride_ate2_m"}, "closed_loop": ends,
    }  # fmt: skip
    assert {kind: score.strides_true for kind, score in scores.items()} == {
        "none": None, "position": None, "strides": 26, "closed_loop": None,
    }  # fmt: skip
    assert scores["none"].strides == 26
    assert scores["none"].stance_share == pytest.approx(50 / 120, abs=0.02)
    assert 0.0 < scores["position"].error_m < scores["position"].ate3_m


def test_the_summary_is_that_of_the_recordings_that_can_tell(scores):
    strides = replace(scores["strides"], strides=29, stride_ate2_m=1.5)
    lost = replace(scores["position"], ate2_m=math.nan)
    near = replace(scores["position"], ate2_m=0.5)
    loop = replace(scores["closed_loop"], closure_2d_m=2.0, closure_3d_m=3.0)
    other = replace(scores["none"], closure_2d_m=9.0)
    whole = summary([strides, lost, near, loop, other])
    assert (whole.recordings, whole.mean_m, whole.median_m, whole.worst_m) == (3, 1.0, 1.0, 1.5)
    assert whole.failed == 2  # over a metre, and no number
    assert (whole.counted, whole.strides_wrong) == (1, 3)
    assert (whole.loops, whole.closure_2d_m, whole.closure_3d_m) == (1, 2.0, 3.0)


def test_a_summary_of_nothing_known_is_no_number(scores):
    nothing = summary([scores["none"]])
    assert (nothing.recordings, nothing.failed, nothing.counted, nothing.loops) == (0, 0, 0, 0)
    assert all(math.isnan(x) for x in (nothing.mean_m, nothing.worst_m, nothing.closure_2d_m))
