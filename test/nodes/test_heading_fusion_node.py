"""Node `heading_fusion`: every step is answered, and the person is where the fusion alone finds her."""

from dataclasses import replace

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path
from tf2_msgs.msg import TFMessage

from pdr_core.fusion.foot_rows import NO_ROWS
from pdr_core.parameter import ParameterError
from pdr_core.records import HeadingSource, joined, length
from pdr_nodes.convert import nav_block
from pdr_nodes.heading_fusion_node import HeadingFusionNode
from pdr_nodes.qos import ANSWERS, LATEST, STATUS
from support.bench import Bench
from support.feet import FEET, FootOnTopics, both_walk, halves, offline_body
from support.walks import stamps

WALK = both_walk(4.8)
HOUR_NS = 3_600_000_000_000


class Person:
    """The node with both feet, and all that it says of the person."""

    def __init__(self, bench, names=FEET):
        self.bench = bench
        self.odometry, self.transforms = bench.hear(Odometry, "odom"), bench.hear(TFMessage, "/tf", 10_000)
        self.paths, self.diagnostics = (
            bench.hear(Path, "path", LATEST),
            bench.hear(DiagnosticArray, "/diagnostics", STATUS),
        )
        self.feet = {name: FootOnTopics(bench, name) for name in names}

    def until_over(self):
        """Wait until every sample of both feet is estimated and every step answered."""
        for foot in self.feet.values():
            foot.end()
        for name, foot in self.feet.items():
            self.until_end(foot, WALK[name])
        for name, foot in self.feet.items():
            self.bench.until(lambda f=foot: len(f.answers) == len(f.steps), f"the answers of {name}")

    def until_end(self, foot, samples):
        self.bench.until(lambda: foot.latest_ns == samples.stamp_ns[-1], f"the end of {foot.name}")

    def heard(self, count):
        self.bench.until(lambda: len(self.odometry) >= count, f"{count} estimates")
        return joined([nav_block(message) for message in self.odometry])

    def said(self, kind):
        self.bench.until(lambda: kind in repr(self.diagnostics), f"the notice {kind}")


@pytest.fixture
def person():
    with Bench(HeadingFusionNode, node__answer_timeout_s=0.0, node__idle_s=0.4) as bench:
        yield Person(bench)


@pytest.fixture
def hurried():
    """One that waits for a foot for 0.1 s."""
    with Bench(HeadingFusionNode, node__answer_timeout_s=0.2, node__idle_s=1.0) as bench:
        yield Person(bench)


@pytest.mark.parametrize("order", [("left", "right"), ("right", "left")])
def test_the_person_is_that_of_the_fusion_alone_whoever_comes_first(person, order):
    for foot in order:
        person.feet[foot].walk(WALK[foot])
    person.until_over()
    expected = offline_body(WALK)
    nav = person.heard(length(expected))
    for name, live, offline in zip(nav._fields, nav, expected, strict=False):
        np.testing.assert_array_equal(live, offline, err_msg=name)
    assert [step.index for step in person.feet["left"].steps] == [a.step_index for a in person.feet["left"].answers]
    assert length(nav) > 500


def test_transform_and_path_are_the_way_of_the_person(person):
    for foot in FEET:
        person.feet[foot].walk(WALK[foot])
    person.until_over()
    count = length(offline_body(WALK))
    person.heard(count)
    person.bench.until(lambda: len(person.transforms) == count, "a transform for every estimate")
    single = [message.transforms[0] for message in person.transforms]
    assert stamps(single) == stamps(person.odometry)
    assert {(t.header.frame_id, t.child_frame_id) for t in single} == {("odom", "base_footprint")}
    person.bench.until(lambda: len(person.paths[-1].poses) > 5, "a path")
    path = person.paths[-1]
    x = [place.pose.position.x for place in path.poses]
    assert path.header.frame_id == "odom"
    assert np.diff(x).min() > -0.01
    assert np.diff(stamps(path.poses)).min() >= 1e9 - 20e6
    numbers = [getattr(t.transform.translation, axis) for t in single for axis in "xyz"]
    assert np.isfinite([*numbers, *x]).all()


def test_a_path_keeps_its_last_places_and_no_transform_comes_where_it_is_switched_off():
    asked = {"node__path_places": 3, "node__path_rate_hz": 10.0, "node__publish_base_tf": False}
    with Bench(HeadingFusionNode, node__idle_s=0.4, **asked) as bench:
        person = Person(bench)
        for foot in FEET:
            person.feet[foot].walk(WALK[foot])
        person.until_over()
        assert max(len(path.poses) for path in person.paths) == 3
        assert person.transforms == []
        assert bench.me.count_publishers("/tf") == 0


def test_a_lost_foot_is_gone_on_without_and_comes_back(hurried):
    first, later = halves(WALK["left"])
    hurried.feet["left"].walk(first)
    hurried.feet["right"].walk(WALK["right"])
    hurried.feet["right"].end()
    hurried.until_end(hurried.feet["right"], WALK["right"])
    lost_ns = hurried.feet["left"].latest_ns
    hurried.said("no_input_left")
    alone = joined([nav_block(message) for message in hurried.odometry])
    hurried.feet["left"].walk(later)
    hurried.until_over()
    variance = alone.pose_covariance[:, 0, 0]
    assert alone.stamp_ns[-1] > lost_ns + 1e9
    assert variance[alone.stamp_ns > lost_ns + 5e8].min() > variance[alone.stamp_ns < lost_ns].max()


def test_a_foot_that_comes_back_with_another_clock_keeps_nobody_waiting(hurried):
    for foot in FEET:
        hurried.feet[foot].walk(halves(WALK[foot])[0])
    restarted = FootOnTopics(hurried.bench, "left")
    earlier = WALK["left"]._replace(stamp_ns=WALK["left"].stamp_ns - HOUR_NS // 2)
    hurried.feet["right"].walk(halves(WALK["right"])[1])
    restarted.walk(earlier)
    for foot, samples in ((hurried.feet["right"], WALK["right"]), (restarted, earlier)):
        foot.end()
        hurried.until_end(foot, samples)
    hurried.bench.until(lambda: WALK["right"].stamp_ns[-1] - stamps(hurried.odometry[-1:])[0] < 1e9, "the person's end")
    assert np.isfinite(joined([nav_block(m) for m in hurried.odometry]).position_m).all()


def broken(step):
    """A step whose numbers are none."""
    nan = np.full(3, np.nan)
    return replace(step, position_m=nan, displacement_m=nan, yaw_rad=np.nan)


@pytest.mark.parametrize("kind", ["nan", "twice", "frame"])
def test_a_step_that_cannot_be_used_is_answered_all_the_same(person, kind):
    left, right = person.feet["left"], person.feet["right"]
    right.walk(WALK["right"])
    output = left.chain.run(WALK["left"])
    if kind == "frame":
        left.frames = ("map", "left_foot")
    else:
        left.tell(replace(output, steps=[]))
    for step in output.steps:
        left.tell(replace(output, nav=NO_ROWS, steps={"nan": [broken(step)], "twice": [step, step]}.get(kind, [step])))
    person.bench.until(lambda: left.answers, "an answer")
    assert left.answers[0].source is HeadingSource.NONE
    if kind == "frame":
        person.said("wrong_frame_left")
    else:
        person.bench.until(lambda: right.answers, "an answer to the other foot, which goes on")


@pytest.mark.parametrize("kind", ["nan", "frame"])
def test_an_estimate_that_cannot_be_used_is_named_and_does_not_reach_the_person(person, kind):
    left, right = person.feet["left"], person.feet["right"]
    right.walk(WALK["right"])
    output = left.chain.run(WALK["left"])
    if kind == "frame":
        left.frames = ("map", "left_foot")
    else:
        output.nav.position_m[100:120] = np.nan
    left.tell(replace(output, steps=[]))
    person.said({"nan": "odometry_no_number", "frame": "wrong_frame_left"}[kind])
    if kind == "nan":
        nav = person.heard(300)
        assert all(np.isfinite(column).all() for column in nav)
    else:
        assert person.odometry == []


def test_a_foot_that_never_comes_keeps_nobody_waiting(hurried):
    left = hurried.feet["left"]
    left.walk(WALK["left"])
    left.end()
    hurried.until_end(left, WALK["left"])
    hurried.bench.until(lambda: stamps(hurried.odometry[-1:]) == [left.latest_ns], "the person's end")
    hurried.said("no_input_right")


def test_one_foot_is_a_person_too():
    held = {"heading__constraint": "dominant", "heading__straight_strides": 2}
    with Bench(HeadingFusionNode, node__feet="foot", node__idle_s=0.4, **held) as bench:
        person = Person(bench, ["foot"])
        foot = person.feet["foot"]
        foot.walk(WALK["left"])
        foot.end()
        person.until_end(foot, WALK["left"])
        bench.until(lambda: len(foot.answers) == len(foot.steps) >= 4, "an answer to every step")
        bench.until(lambda: stamps(person.odometry[-1:]) == [foot.latest_ns], "the person's end")
        assert HeadingSource.STRAIGHT_WALK in {answer.source for answer in foot.answers}
        person.said("heading_on")


def test_feet_that_call_themselves_the_same_are_named(person):
    for foot in person.feet.values():
        foot.frames = ("odom", "foot")
        foot.walk(WALK[foot.name])
    person.said("same_foot_frame")


@pytest.mark.parametrize("feet", ["", "left left", "left right third", "left,right", "1st"])
def test_other_than_one_or_two_names_are_refused(feet):
    with pytest.raises(ParameterError, match=r"node\.feet"), Bench(HeadingFusionNode, node__feet=feet):
        pass


def test_an_answer_waits_for_the_foot_that_asked(hurried):
    """The filter of the foot may be found later than what it says."""
    left = hurried.feet["left"]
    hurried.bench.me.destroy_subscription(left.hears)
    publisher = hurried.bench.node._feet["left"]._answers._publisher
    hurried.bench.until(lambda: not publisher.get_subscription_count(), "nobody who listens")
    for foot in FEET:
        hurried.feet[foot].walk(WALK[foot])
    hurried.bench.until(lambda: hurried.feet["right"].answers, "an answer to the right foot")
    assert left.steps
    assert not left.answers
    left.listen()
    hurried.until_over()


def test_the_person_is_placed_and_the_feet_stay_in_their_worlds(person):
    for foot in FEET:
        person.feet[foot].walk(halves(WALK[foot])[0])
    before = length(person.heard(200))
    message = PoseWithCovarianceStamped()
    message.header.frame_id = "odom"
    message.pose.pose.position.x, message.pose.pose.orientation.z = 500.0, 1.0  # looks back
    message.pose.covariance = np.diag([0.25, 0.25, 0.25, 1e-4, 1e-4, 0.01]).ravel()
    person.bench.publisher(PoseWithCovarianceStamped, "initialpose", ANSWERS).publish(message)
    person.said("placed by initialpose")
    for foot in FEET:
        person.feet[foot].walk(halves(WALK[foot])[1])
    person.until_over()
    expected = offline_body(WALK)
    nav = person.heard(length(expected))
    moved_m = nav.position_m[-1] - [500.0, 0.0, 0.0]
    own_m = expected.position_m[-1] - expected.position_m[before - 1 :]
    assert np.abs(moved_m[0] + own_m[:, 0]).min() < 0.01  # as far as on her own way, and back
    assert np.linalg.norm(moved_m[:2]) > 1.0
    for foot in FEET:
        assert abs(person.feet[foot].chain.state.position_m[0]) < 10.0
