"""Node `external_odometry`: as an aid it gives what the aided foot gives offline, and compared it says how both lie."""

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PointStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from pdr_core.maths.circular import wrapped_rad
from pdr_core.parameter import ParameterError
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import AidedFeet, AidedFoot, AidedFusion
from pdr_core.records import joined, length, part
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock, about_up, unknown_yaws
from pdr_core.simulation import simulated_feet
from pdr_core.simulation.external_source import ExternalSource, fixes, midway
from pdr_nodes.convert import odometry_message, time_message
from pdr_nodes.convert_external import comparison_message, fix_block
from pdr_nodes.external_odometry_node import ExternalOdometryNode
from pdr_nodes.qos import ANSWERS, LATEST, OWN, STATUS
from support.bench import Bench
from support.feet import FootOnTopics
from support.walks import BEGIN_NS

SOURCE = ExternalSource(noise_sd_m=0.1)
AID = {"external__mode": "aid", "node__feet": "left"}
FEW = 200  # samples before the first fix: so soon that the clocks agree


@pytest.fixture(scope="module")
def walks():
    """The samples of both feet, and the fixes of somebody who follows the body."""
    params = SimulationParams(walk="rectangle", walk_length_m=60.0, motion="smooth", sample_rate_hz=100.0, seed=3)
    feet = simulated_feet(params, start_ns=BEGIN_NS)
    said = fixes(midway(feet["left"].truth, feet["right"].truth), SOURCE)
    return {name: foot.imu for name, foot in feet.items()}, said


@pytest.fixture(scope="module")
def walk(walks):
    """Those of the left foot alone."""
    return walks[0]["left"], walks[1]


@pytest.fixture
def taken(monkeypatch):
    """The stamps of the fixes that the node has taken."""
    stamps_ns, take = [], AidedFusion.fixes

    def counted(fusion, said, *more):
        stamps_ns.extend(said.stamp_ns)
        return take(fusion, said, *more)

    monkeypatch.setattr(AidedFusion, "fixes", counted)
    return stamps_ns


def message_of(said, i, kind, frame="map"):
    message = kind()
    message.header.stamp, message.header.frame_id = time_message(int(said.stamp_ns[i])), frame
    place = message.pose.pose.position
    place.x, place.y, place.z = said.position_m[i].tolist()
    covariance = np.zeros(36)
    covariance[[0, 7, 14]] = said.variance_m2[i]
    message.pose.covariance = covariance
    return message


@pytest.mark.parametrize(
    ("said", "known"),
    [([0.1, 0.2, 0.3], [0.1, 0.2, 0.3]), ([0.1, 0.2, 0.0], [0.1, 0.2, 0.0]), ([np.nan, 4.0, 1.0], [0.0, 0.0, 0.0]),
     ([0.0, 0.04, 1.0], [0.0, 0.0, 0.0])],
)  # fmt: skip
def test_variances_that_are_none_are_as_unknown_as_they_are_in_a_bag(said, known):
    fixes_said = FixBlock(np.array([BEGIN_NS]), np.zeros((1, 3)), np.array([said]), unknown_yaws(1))
    np.testing.assert_array_equal(fix_block(message_of(fixes_said, 0, Odometry)).variance_m2, [known])


def offline(imu, said):
    foot = AidedFoot(changed(Params(), "external", mode="aid"))
    outputs = [foot.run(part(imu, 0, FEW))]
    foot.fixes(said)
    outputs += [foot.run(part(imu, FEW)), foot.finish()]
    return foot, joined([output.nav for output in outputs])


def tell_fixes(bench, external, said, kind, taken):
    """Tell all fixes, and wait until the node has them: what comes by another topic may overtake them."""
    for i in range(len(said.stamp_ns)):
        external.publish(message_of(said, i, kind))
        bench.spin()
    bench.until(lambda: len(taken) == len(said.stamp_ns), "all fixes")


def tell(bench, foot, imu, said, kind, taken):
    """Walk, with all fixes after the first samples."""
    person = bench.hear(Odometry, "odom")
    external = bench.publisher(kind, "external")
    bench.until(lambda: bench.me.count_publishers("left/heading_observation"), "who answers")
    foot.walk(part(imu, 0, FEW))
    bench.until(lambda: len(person) > FEW // 4, "the person's first way")
    tell_fixes(bench, external, said, kind, taken)
    foot.walk(part(imu, FEW))
    foot.end()
    bench.until(lambda: foot.latest_ns == int(imu.stamp_ns[-1]), "the end of the walk")


def last_is(messages, shift_m):
    """The last frame that was heard, as a pose or as a transform, lies there."""
    poses = (m.pose.pose.position if hasattr(m, "pose") else m.transforms[0].transform.translation for m in messages)
    places = list(poses)[-1:]
    return any(np.allclose([place.x, place.y, place.z], shift_m, rtol=0.0, atol=1e-9) for place in places)


@pytest.mark.parametrize(("kind", "name"), [(Odometry, "odometry"), (PoseWithCovarianceStamped, "pose")])
def test_as_an_aid_it_answers_as_the_aided_foot_does_offline(walk, kind, name, taken):
    imu, said = walk
    said = said._replace(variance_m2=said.variance_m2 * [1.0, 1.0, 0.0])
    aided, nav = offline(imu, said)
    with Bench(ExternalOdometryNode, **AID, external__message=name, external__publish_tf=True) as bench:
        frames, transforms = (
            bench.hear(PoseWithCovarianceStamped, "external/frame", LATEST),
            bench.hear(TFMessage, "/tf_static", LATEST),
        )
        foot = FootOnTopics(bench, "left")
        tell(bench, foot, imu, said, kind, taken)
        shift_m = aided.frame.shift_m
        bench.until(lambda: last_is(frames, shift_m) and last_is(transforms, shift_m), "the last frame")
    told = [answer for answer in foot.answers if answer.position is not None]
    assert len(told) > 10
    assert foot.latest_ns == int(nav.stamp_ns[-1])
    np.testing.assert_allclose(foot.chain.state.position_m, nav.position_m[-1], atol=1e-9)
    pose = frames[-1]
    assert pose.header.frame_id == "map"
    assert 2.0 * np.arctan2(pose.pose.pose.orientation.z, pose.pose.pose.orientation.w) == pytest.approx(
        aided.frame.yaw_rad
    )
    covariance = np.array(pose.pose.covariance).reshape(6, 6)
    np.testing.assert_allclose(covariance, covariance.T)
    assert np.linalg.eigvalsh(covariance)[0] > 0.0
    (transform,) = transforms[-1].transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ("map", "odom")
    assert transform.transform.translation.x == pytest.approx(aided.frame.shift_m[0])


def test_both_feet_are_aided_as_they_are_offline(walks, taken):
    imus, said = walks
    few = {name: part(imu, 0, FEW) for name, imu in imus.items()}
    both = AidedFeet(Params())
    outputs = [both.run(name, imu) for name, imu in few.items()]
    both.fixes(said)
    outputs += [both.run(name, part(imu, FEW)) for name, imu in imus.items()] + [both.finish()]
    ends = {name: one.nav for output in outputs for name, one in output.feet if length(one.nav)}
    with Bench(ExternalOdometryNode, external__mode="aid", node__answer_timeout_s=0.0) as bench:
        person, external = bench.hear(Odometry, "odom"), bench.publisher(Odometry, "external")
        feet = {name: FootOnTopics(bench, name) for name in imus}
        for name, foot in feet.items():
            bench.until(lambda n=name: bench.me.count_publishers(f"{n}/heading_observation"), "who answers")
            foot.walk(few[name])
        bench.until(lambda: len(person) > FEW // 4, "the person's first way")
        tell_fixes(bench, external, said, Odometry, taken)
        for name, foot in feet.items():
            foot.walk(part(imus[name], FEW))
            foot.end()
        for name, foot in feet.items():
            bench.until(lambda n=name, f=foot: f.latest_ns == int(imus[n].stamp_ns[-1]), f"the end of {name}")
    for name, foot in feet.items():
        assert sum(answer.position is not None for answer in foot.answers) > 10
        np.testing.assert_allclose(foot.chain.state.position_m, ends[name].position_m[-1], atol=1e-9)


def say_points(bench, walk, frame="map"):
    """Estimate a walk, and say at two places of it where they are on the map."""
    imu, said = walk
    _, nav = offline(imu, part(said, 0, 0))
    at = [length(nav) // 4, length(nav) // 2]
    map_m = nav.position_m[at] @ about_up(2.0).T + [30.0, -12.0, 0.0]
    points, odom = bench.publisher(PointStamped, "external", ANSWERS), bench.publisher(Odometry, "odom", OWN)
    for i in range(length(nav)):
        odom.publish(odometry_message(nav, i, "odom", "foot"))
        if i % 50 == 0:
            bench.spin()
        if i in at:
            point = PointStamped()
            point.header.stamp, point.header.frame_id = time_message(int(nav.stamp_ns[i])), frame
            point.point.x, point.point.y, point.point.z = map_m[at.index(i)].tolist()
            bench.until(lambda: not bench.node.waiting, "the estimates so far")
            points.publish(point)
            bench.spin()


@pytest.mark.parametrize("frame", ["", "odom"])
def test_a_transform_that_tf2_does_not_take_is_not_broadcast_but_named(walk, frame):
    with Bench(ExternalOdometryNode, external__message="point", external__publish_tf=True) as bench:
        frames = bench.hear(PoseWithCovarianceStamped, "external/frame", LATEST)
        transforms = bench.hear(TFMessage, "/tf_static", LATEST)
        board = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        say_points(bench, walk, frame)
        bench.until(lambda: frames, "the frame")
        bench.until(lambda: f"no transform from {frame!r} to 'odom'" in board_text(board), "the notice")
        assert transforms == []


def test_fixes_of_two_frames_on_one_topic_are_named(walk):
    _, said = walk
    with Bench(ExternalOdometryNode) as bench:
        board = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        source = bench.publisher(Odometry, "external")
        bench.feed(source, [message_of(said, i, Odometry, "map") for i in range(3)])
        bench.until(lambda: board, "a diagnosis")
        assert "fixes came in frame" not in board_text(board)
        bench.feed(source, [message_of(said, 3, Odometry, "utm")])
        bench.until(lambda: "fixes came in frame 'map' and now in 'utm'" in board_text(board), "the notice")


def board_text(board):
    """What stands on /diagnostics."""
    return " ".join(status.message for message in board for status in message.status)


def test_two_known_points_lay_the_track_on_the_map(walk):
    with Bench(ExternalOdometryNode, external__message="point", external__publish_tf=True) as bench:
        frames = bench.hear(PoseWithCovarianceStamped, "external/frame", LATEST)
        board = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        say_points(bench, walk)
        bench.until(lambda: frames, "the frame")
        bench.until(lambda: "known_points" in repr(board), "the notice")
        assert "no_external" not in repr(board)
    turn = frames[-1].pose.pose.orientation
    assert wrapped_rad(2.0 * np.arctan2(turn.z, turn.w) - 2.0) == pytest.approx(0.0, abs=0.05)
    assert frames[-1].header.frame_id == "map"


def values_of(message):
    return {value.key: float(value.value) for value in message.status[0].values}


def test_compared_it_tells_frame_ate_and_deviations_and_answers_nothing(walk):
    imu, said = walk
    _, nav = offline(imu, part(said, 0, 0))
    with Bench(ExternalOdometryNode) as bench:
        heard = bench.hear(DiagnosticArray, "external/comparison", STATUS)
        external, odom = bench.publisher(Odometry, "external"), bench.publisher(Odometry, "odom", OWN)
        for i in range(0, length(nav), 50):
            for row in range(i, min(i + 50, length(nav))):
                odom.publish(odometry_message(nav, row, "odom", "foot"))
            bench.spin()
            for k in np.flatnonzero((said.stamp_ns >= nav.stamp_ns[i]) & (said.stamp_ns < nav.stamp_ns[i] + 5 * 10**8)):
                external.publish(message_of(said, int(k), Odometry))
            bench.spin()
        bench.until(lambda: heard and "ate_m" in values_of(heard[-1]), "the comparison")
        bench.until(lambda: values_of(heard[-1])["pairs"] > 30, "all pairs")
        assert bench.me.count_publishers("left/heading_observation") == 0
    found = values_of(heard[-1])
    assert 0.05 < found["ate_m"] < 0.5
    assert found["clock_s"] == pytest.approx(SOURCE.clock_s, abs=0.2)
    assert 0.0 < found["yaw_sd_rad"] < 0.03
    assert heard[-1].status[0].message == "aligned"


def test_an_error_that_is_not_known_yet_is_left_out():
    """As in aid mode, when the frame is known and no fix has been judged by it."""
    frame = ExternalFrame(0.5, np.zeros(3), 0, np.eye(4), np.zeros(2))
    found = values_of(comparison_message(ExternalComparison(frame, 0, float("nan")), BEGIN_NS, "node"))
    assert "ate_m" not in found
    assert found["yaw_rad"] == 0.5


def test_known_points_do_not_aid():
    with (
        pytest.raises(ParameterError, match=r"known points lay the track on a map: external.mode compare"),
        Bench(ExternalOdometryNode, external__mode="aid", external__message="point"),
    ):
        pass


def test_nobody_who_says_anything_is_named():
    with Bench(ExternalOdometryNode) as bench:
        heard = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        bench.until(lambda: "no fixes on" in repr(heard), "the notice")
