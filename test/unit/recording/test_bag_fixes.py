"""Somebody else's positions in a bag: of any message that holds some, and in the place where they came."""

import numpy as np
import pytest
from small_bags import IMU, POINT, TYPES, header, imu_cdr, odometry_cdr, point_cdr, pose_cdr, stamp, write_bag

from pdr_core.recording import RecordingError, Session, open_recording
from pdr_core.recording.export import write_recording
from pdr_core.records_external import FixBlock

KINDS = {
    "nav_msgs/msg/Odometry": odometry_cdr,
    "geometry_msgs/msg/PoseStamped": pose_cdr,
    POINT: point_cdr,
}
FIX = "geometry_msgs/msg/PoseWithCovarianceStamped"


def with_covariance(i, variances):
    types = TYPES.types
    covariance = np.zeros(36)
    covariance[[0, 7, 14]] = variances
    point = types["geometry_msgs/msg/Point"](1.0, 2.0, float(i))
    pose = types["geometry_msgs/msg/Pose"](point, types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0))
    message = types[FIX](header(i, "map"), types["geometry_msgs/msg/PoseWithCovariance"](pose, covariance))
    return bytes(TYPES.serialize_cdr(message, FIX))


def opened(tmp_path, *fixes):
    """A bag of six samples, after the second and the fifth of which somebody spoke."""
    samples = [("/foot/data_raw", IMU, imu_cdr(i)) for i in range(6)]
    messages = [*samples[:2], fixes[0], *samples[2:5], *fixes[1:], samples[5]]
    write_bag(tmp_path / "bag", messages, "mcap")
    return open_recording(tmp_path / "bag")


@pytest.mark.parametrize("kind", KINDS)
def test_every_message_with_a_position_will_do(tmp_path, kind):
    session = opened(tmp_path, ("/robot", kind, KINDS[kind](2)), ("/robot", kind, KINDS[kind](5)))
    found = session.arrivals(["foot"], "/robot")
    assert found.after_samples.tolist() == [[2], [5]]
    assert found.fixes.stamp_ns.tolist() == [stamp(2), stamp(5)]
    moving = {"nav_msgs/msg/Odometry": 2, "geometry_msgs/msg/PoseStamped": 1, POINT: 0}[kind]
    assert found.fixes.position_m[:, moving].tolist() == [2.0, 5.0]
    assert (found.fixes.variance_m2 == 0.0).all()


def test_they_stand_between_the_samples_of_both_feet(tmp_path):
    left, right = (lambda i, t=t: (t, IMU, imu_cdr(i)) for t in ("/left/data_raw", "/right/data_raw"))
    fixes = [("/robot", POINT, point_cdr(i)) for i in range(3)]
    write_bag(tmp_path / "bag", [fixes[0], left(0), left(1), fixes[1], right(1), left(2), fixes[2], right(2)], "mcap")
    session = open_recording(tmp_path / "bag")
    assert session.arrivals(["left", "right"], "/robot").after_samples.tolist() == [[0, 0], [2, 0], [3, 1]]
    assert session.arrivals(["right", "left"], "/robot").after_samples.tolist() == [[0, 0], [0, 2], [1, 3]]


@pytest.mark.parametrize(
    ("said", "known"),
    [([0.1, 0.2, 0.3], [0.1, 0.2, 0.3]), ([0.1, 0.2, 0.0], [0.1, 0.2, 0.0]), ([-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
     ([np.nan, 1.0, 1.0], [0.0, 0.0, 0.0])],
)  # fmt: skip
def test_variances_that_are_none_are_unknown(tmp_path, said, known):
    session = opened(tmp_path, ("/robot", FIX, with_covariance(2, said)), ("/robot", FIX, with_covariance(5, said)))
    np.testing.assert_array_equal(session.arrivals(["foot"], "/robot").fixes.variance_m2, [known, known])


def test_a_damaged_message_is_left_out_and_named(tmp_path):
    session = opened(tmp_path, ("/robot", FIX, with_covariance(2, [1.0] * 3)), ("/robot", FIX, b"\0\1\0\0\1"))
    assert len(session.arrivals(["foot"], "/robot").fixes.stamp_ns) == 1
    assert [(n.kind, n.count) for n in session.notices] == [("unreadable_message", 1)]


def test_a_topic_without_positions_is_refused_with_those_that_have_some(tmp_path):
    session = opened(tmp_path, ("/robot", FIX, with_covariance(2, [1.0] * 3)))
    for topic in ("/nobody", "/foot/data_raw"):
        with pytest.raises(RecordingError, match=f"{topic}: the recording holds no positions.*it has: /robot"):
            session.arrivals(["foot"], topic)


def test_what_is_written_is_read_again(tmp_path):
    session = opened(tmp_path, ("/robot", FIX, with_covariance(2, [1.0] * 3)))
    fixes = FixBlock(
        np.array([stamp(0), stamp(4)]), np.arange(6.0).reshape(2, 3), np.full((2, 3), 0.09), np.array([-2.0, np.nan])
    )
    beside = Session(session.name, session.path, session.format, session.sensors, beside={"/else": fixes})
    write_recording(beside, list(session.sensors.values()), tmp_path / "again")
    found = open_recording(tmp_path / "again").arrivals(["foot"], "/else").fixes
    for column, written in zip(found, fixes, strict=True):
        np.testing.assert_allclose(column, written, rtol=1e-15)
