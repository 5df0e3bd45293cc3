"""Live, what waits is given out once a stream pauses; offline, it waits. A gap must make both the same."""

import numpy as np
import pytest

from pdr_core.eskf import ZuptFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import joined, part
from pdr_core.stance import StanceDetection
from support.walks import straight_walk

RATE_HZ = 200


def estimated(pieces, flush):
    params = Params()
    intake = Ingestion(params.intake)
    stance = StanceDetection(params.stance, params.place)
    walk = ZuptFilter(params.filter, params.place)
    navs, steps = [], []
    for piece in pieces:
        judged = [stance.run(intake.run(piece))]
        judged += [stance.run(intake.finish()), stance.finish()] if flush or piece is pieces[-1] else []
        for block in judged:
            nav, taken = walk.run(block)
            navs.append(nav)
            steps += taken
        steps += walk.finish() if flush or piece is pieces[-1] else []
    return joined(navs), steps


@pytest.mark.parametrize("cut_s", [4.02, 4.03, 4.2, 4.6, 5.1, 5.45, 6.0])  # in swings, in stances, just begun
def test_a_pause_of_the_stream_and_a_gap_in_a_recording_are_the_same(cut_s):
    imu = straight_walk(8, RATE_HZ).imu
    cut = round(cut_s * RATE_HZ)
    late = part(imu, cut + 3 * RATE_HZ // 2)
    pieces = [part(imu, 0, cut), late._replace(stamp_ns=late.stamp_ns + 1_500_000_000)]
    live, live_steps = estimated(pieces, flush=True)
    offline, offline_steps = estimated(pieces, flush=False)
    assert np.array_equal(live.stamp_ns, offline.stamp_ns)
    assert np.array_equal(live.position_m, offline.position_m)
    assert [s.stamp_ns for s in live_steps] == [s.stamp_ns for s in offline_steps]
