import numpy as np

from pdr_core.attitude import UnjudgedQuaternionFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.pipeline import OrientedIntake
from pdr_core.records import joined, length, part
from support.walks import straight_walk

RAW = straight_walk(3, 200.0).imu


def test_it_is_the_intake_and_then_the_filter_however_it_is_cut():
    intake = Ingestion(Params().intake)
    samples = joined([intake.run(RAW), intake.finish()])
    expected = UnjudgedQuaternionFilter(Params()).run(samples)
    chain = OrientedIntake(Params())
    pieces = [chain.run(part(RAW, start, start + 37)) for start in range(0, length(RAW), 37)] + [chain.finish()]
    imu, attitude = (joined([piece[i] for piece in pieces]) for i in range(2))
    for one, other in zip((*imu, *attitude), (*samples, *expected), strict=True):
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(imu.stamp_ns, attitude.stamp_ns)


def test_it_says_what_both_say():
    chain = OrientedIntake(Params())
    broken = RAW._replace(gyro_radps=np.where(np.arange(length(RAW))[:, None] == 500, np.nan, RAW.gyro_radps))
    late = part(broken, 900)
    chain.run(part(broken, 0, 600))
    chain.run(late)
    assert "not_finite" in {notice.kind for notice in chain.notices}
    assert "attitude_coasted" in {notice.kind for notice in chain.orientation_notices}
