"""The fusion of two feet does not depend on when and in which pieces anything arrives, and survives what streams do."""

import numpy as np
import pytest
from feet_cases import FEET, Messages, Together, by_messages, feet_walks, later, midway_m, samples, yaw_rad

from pdr_core.fusion.foot_rows import room
from pdr_core.params import Params, changed
from pdr_core.pipeline import FootInertial, HeadingFusion
from pdr_core.records import HeadingSource, StepEvent, joined, length, part

RNG = np.random.default_rng(6)
STRAIGHT = {"walk": "straight", "length_m": 36.0}


def same(one, other):
    return all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_any_order_of_arrival_gives_the_same_body_and_the_same_answers():
    first, answers = by_messages(samples(**STRAIGHT), np.random.default_rng(0))
    told = {(foot, a.step_index): a.yaw_error_rad for foot, a in answers if a.source is HeadingSource.OTHER_FOOT}
    assert len(told) > 5
    for seed in range(1, 4):
        other, others = by_messages(samples(**STRAIGHT), np.random.default_rng(seed))
        n = min(length(first), length(other))  # where a stream just stops, the last rows wait for more
        assert n > 0.9 * length(first)
        assert same(part(first, 0, n), part(other, 0, n))
        also = {(foot, a.step_index): a.yaw_error_rad for foot, a in others if a.source is HeadingSource.OTHER_FOOT}
        assert {k: v for k, v in also.items() if k in told} == {k: v for k, v in told.items() if k in also}


def test_messages_give_what_both_feet_give_offline():
    live, _ = by_messages(samples(), np.random.default_rng(7))
    offline = Together(samples()).body
    assert same(live, part(offline, 0, length(live)))


@pytest.mark.parametrize("piece", [37, 1000, 10**6])
def test_pieces_do_not_matter(piece):
    assert same(Together(samples(), piece=piece).body, Together(samples()).body)


def test_the_body_is_between_the_feet_and_looks_ahead():
    found, walks = Together(samples()), feet_walks()
    off_m = found.body.position_m - midway_m(walks, found.body.stamp_ns)
    assert np.abs(off_m[:, :2]).max() < 0.3
    ahead = [np.cos(yaw_rad(found.body)), np.sin(yaw_rad(found.body))]
    true_mps = np.gradient(midway_m(walks, found.body.stamp_ns)[:, :2], found.body.stamp_ns / 1e9, axis=0)
    walking = np.linalg.norm(true_mps, axis=1) > 0.8
    along = np.einsum("ij,ji->i", true_mps[walking], np.array(ahead)[:, walking]) / np.linalg.norm(
        true_mps[walking], axis=1
    )
    assert np.median(along) > 0.99
    assert np.mean(found.body.velocity_mps[walking, 0]) == pytest.approx(
        np.mean(np.linalg.norm(true_mps[walking], axis=1)), rel=0.05
    )


def test_a_lost_foot_holds_nothing_up_and_comes_back():
    """The right foot's stream breaks off for 4 s, and its filter goes on from a gap."""
    imus, walks = samples(**STRAIGHT), feet_walks(**STRAIGHT)
    right = imus["right"]
    t = (right.stamp_ns - right.stamp_ns[0]) / 1e9
    broken = {"left": imus["left"], "right": type(right)(*(column[(t < 12.0) | (t > 16.0)] for column in right))}
    body = Together(broken).body
    t = (body.stamp_ns - body.stamp_ns[0]) / 1e9
    assert np.diff(t).max() < 0.05
    off_m = (body.position_m - midway_m(walks, body.stamp_ns))[:, :2]
    sd_m = np.sqrt(body.pose_covariance[:, [0, 1], [0, 1]])
    assert np.abs(off_m[t < 11.9]).max() < 0.1
    assert sd_m[t < 11.9, 0].max() < 0.1
    assert sd_m[(t > 12.1) & (t < 15.9), 0].min() > 0.24  # of one foot alone
    assert 0.2 < np.abs(off_m[t > 12.1]).max() < 0.5
    assert (np.abs(off_m) < 3.0 * sd_m + 0.01).all()


def test_a_foot_that_left_live_is_waited_for_no_longer():
    fusion, nav = HeadingFusion(Params(), FEET), Together(samples()).nav
    left, right = nav("left"), nav("right")
    assert length(fusion.odometry("left", part(left, 0, 300)).body) == 0
    assert length(fusion.odometry("right", part(right, 0, 100)).body) == 100
    alone = fusion.leave("right").body
    assert length(alone) == 200
    assert length(fusion.odometry("left", part(left, 300, 400)).body) == 100
    fusion.odometry("right", part(right, 350, 420))
    assert length(fusion.odometry("left", part(left, 400, 410)).body) == 10
    assert fusion.notices == []


def test_a_foot_whose_filter_was_started_anew_is_found_beside_the_other():
    """The right sensor is switched off on the way and begins anew, at an origin of its own."""
    imus, walks = samples(**STRAIGHT), feet_walks(**STRAIGHT)
    right = imus["right"]
    off_ns = int(right.stamp_ns[0]) + 14_000_000_000
    again = stance_begin(walks["right"], off_ns + 2_000_000_000)
    found = TwoFilters(imus["left"], (part(right, 0, int(np.searchsorted(right.stamp_ns, off_ns))), part(right, again)))
    body, began_ns = found.body, int(right.stamp_ns[again])
    assert np.diff(body.stamp_ns).max() < 50_000_000
    off_m = (body.position_m - midway_m(walks, body.stamp_ns))[:, :2]
    assert (np.abs(off_m) < 3.0 * np.sqrt(body.pose_covariance[:, [0, 1], [0, 1]]) + 0.01).all()
    assert np.abs(off_m[body.stamp_ns > began_ns + 2_000_000_000]).max() < 0.5
    assert np.linalg.norm((found.ends_m["left"] - found.ends_m["right"])[:2]) < 0.8  # not at an origin far behind


def stance_begin(walk, after_ns):
    """Return the first sample after a stamp at which the foot has stood for a while and will."""
    still = np.linalg.norm(walk.motion.velocity_mps, axis=1) < 1e-6
    runs = np.convolve(still, np.ones(15), mode="same") > 14.5
    return int(np.flatnonzero(runs & (walk.imu.stamp_ns > after_ns))[0])


class TwoFilters:
    """A left filter, and two right ones after each other, all answered by one fusion."""

    def __init__(self, left, rights):
        params = changed(Params(), "filter", heading_feedback=True)
        self.fusion, self.bodies, self.last = HeadingFusion(params, FEET), [], {}
        chains = {"left": FootInertial(params, heading=None)}
        pieces = [("left", piece, False) for piece in cut(left)]
        pieces += [("right", piece, i == 0) for imu in rights for i, piece in enumerate(cut(imu))]
        for foot, piece, anew in sorted(pieces, key=lambda item: int(item[1].stamp_ns[0])):
            answers = []
            if anew:
                chains[foot] = FootInertial(params, heading=None)
                answers = self.keep(self.fusion.leave(foot)) if foot in self.last else []
            new = [(name, chains[name].answer(answer)) for name, answer in answers if name != foot]
            new.append((foot, chains[foot].run(piece)))
            while new:
                answers = [answer for name, output in new for answer in self.told(name, output)]
                new = [(name, chains[name].answer(answer)) for name, answer in answers]
        self.keep(self.fusion.finish())
        self.body = joined(self.bodies)
        self.ends_m = {foot: self.fusion.placed_m(foot, nav.position_m[-1:])[0] for foot, nav in self.last.items()}

    def told(self, foot, output):
        answers = [answer for step in output.steps for answer in self.keep(self.fusion.step(foot, step))]
        self.last[foot] = output.nav if length(output.nav) else self.last.get(foot, output.nav)
        return answers + self.keep(self.fusion.odometry(foot, output.nav))

    def keep(self, told):
        self.bodies.append(told.body)
        return told.answers


def cut(imu, piece=100):
    return [part(imu, i, i + piece) for i in range(0, length(imu), piece)]


@pytest.mark.parametrize("shift_s", [0.5, -0.5])
def test_clocks_that_differ_a_little_break_nothing(shift_s):
    imus = samples(walk="straight", length_m=76.0, sensor="g_sensitive")
    exact = Together(imus)
    found = Together({"left": imus["left"], "right": later(imus["right"], shift_s)})
    ends_m = [
        t.body.position_m[np.searchsorted(t.body.stamp_ns, imus["left"].stamp_ns[-1]) - 60, :2] for t in (exact, found)
    ]
    assert np.linalg.norm(ends_m[0] - ends_m[1]) < 0.3
    assert found.kinds == []


def test_a_clock_that_counts_from_the_start_of_its_device_is_aligned_and_named():
    imus = samples()
    booted = {"left": imus["left"], "right": later(imus["right"], -1.7e9 + 12.0)}
    found, exact = Together(booted), Together(imus)
    assert found.kinds == ["clocks_apart"]
    assert same(found.body, exact.body)
    assert np.array_equal(found.nav("right").position_m, exact.nav("right").position_m)  # answered on its own clock


def test_what_a_clock_that_jumps_back_brings_is_survived():
    imus = samples()
    looped = {foot: joined([imu, later(imu, -3.0)]) for foot, imu in imus.items()}
    found = Together(looped)
    assert "clock_jumped_back" in found.kinds
    assert length(found.body) > 1.5 * length(imus["left"])
    assert np.isfinite(found.body.position_m).all()


@pytest.mark.parametrize("shift_s", [-1800.0, -3.0])
def test_a_foot_that_is_started_anew_with_another_clock_holds_nobody_up_for_long(shift_s):
    walk = samples(**STRAIGHT)
    killed = part(walk["left"], 0, length(walk["left"]) // 2)
    lives = {"left": [killed, later(walk["left"], shift_s)], "right": [walk["right"]]}
    kinds = set()
    for seed in range(12):
        feet = Messages(lives, np.random.default_rng(seed))
        feet.run()
        losses = 0
        while feet.lose_patience():
            losses += 1
            feet.run()
        assert losses <= 2, seed
        answered = {foot: [a.step_index for name, a in feet.answers if name == foot] for foot in FEET}
        assert answered["right"] == list(range(1, answered["right"][-1] + 1))
        assert len(answered["right"]) == len(feet.steps["right"])
        assert answered["left"].count(1) == 2
        assert answered["left"][-1] == feet.steps["left"][-1].index
        body = joined([body for body in feet.bodies if length(body)])
        assert np.isfinite(body.position_m).all()
        assert length(body) > 0.5 * length(walk["right"])  # one that is far behind is not waited for
        kinds |= {notice.kind for notice in feet.fusion.notices}
    assert {"clock_jumped_back", "clocks_apart"} <= kinds


def test_a_foot_whose_clock_jumps_twice_leaves_the_person_on_the_clock_of_the_other():
    left, right = (FootInertial(Params(), heading=None).run(samples()[foot]).nav for foot in FEET)
    half, start = length(right) // 2, part(left, 0, 50)
    fusion = HeadingFusion(Params(), FEET)
    fusion.odometry("left", part(left, 0, half))
    fusion.odometry("right", part(right, 0, half))
    for back_ns in (1800 * 10**9, 3600 * 10**9):
        fusion.odometry("left", start._replace(stamp_ns=start.stamp_ns - back_ns))
    fusion.odometry("right", part(right, half))
    assert fusion.leave("left").body.stamp_ns[-1] == right.stamp_ns[-1]
    assert {notice.kind: notice.count for notice in fusion.notices} == {"clock_jumped_back": 2, "clocks_apart": 2}


def test_a_step_that_comes_before_the_clock_of_its_foot_is_answered_on_that_clock():
    booted = {"left": later(samples(**STRAIGHT)["left"], -1.7e9), "right": samples(**STRAIGHT)["right"]}
    left, right = (FootInertial(changed(Params(), "filter", heading_feedback=True)).run(booted[foot]) for foot in FEET)
    fusion = HeadingFusion(Params(), FEET)
    fusion.leave("right")
    told = [fusion.odometry("left", left.nav), fusion.step("right", right.steps[0])]
    told += [fusion.odometry("right", right.nav), fusion.leave("left"), fusion.finish()]
    (answer,) = [answer for output in told for _, answer in output.answers]
    step = right.steps[0]
    assert (answer.step_ns, answer.applies_from_ns) == (step.stamp_ns, step.answer_due_ns)


def test_rows_that_are_no_numbers_are_named_and_left_out():
    fusion, nav = HeadingFusion(Params(), ("foot",)), room(3)
    nav.stamp_ns[:], nav.quat_xyzw[:, 3] = [1, 2, 3], 1.0
    nav.position_m[1] = np.nan
    assert fusion.odometry("foot", nav).body.stamp_ns.tolist() == [1, 3]
    assert [n.kind for n in fusion.notices] == ["odometry_no_number"]
    assert length(fusion.odometry("foot", part(nav, 0, 0)).body) == 0


def test_one_foot_alone_is_its_own_body_and_every_step_is_answered():
    fusion = HeadingFusion(Params(), ("foot",))
    nav = Together(samples()).nav("left")
    assert same(fusion.odometry("foot", part(nav, 0, 50)).body.position_m, nav.position_m[:50])
    event = StepEvent(
        1,
        int(nav.stamp_ns[0]),
        int(nav.stamp_ns[60]),
        np.zeros(3),
        np.ones(3),
        np.eye(3),
        0.0,
        0.1,
        int(nav.stamp_ns[90]),
    )
    assert fusion.step("foot", event).answers == []  # its place is not known yet
    ((foot, answer),) = fusion.odometry("foot", part(nav, 50, 80)).answers
    assert (foot, answer.step_index, answer.applies_from_ns, answer.empty) == ("foot", 1, event.answer_due_ns, True)


def test_a_foot_that_waits_for_no_answer_is_named():
    fusion = HeadingFusion(Params(), FEET)
    nav = Together(samples()).nav("left")
    for foot in FEET:
        fusion.odometry(foot, part(nav, 0, 5))
    fusion.step("left", StepEvent(1, 0, 1, np.zeros(3), np.ones(3), np.eye(3), 0.0, 0.1))
    assert [n.kind for n in fusion.notices] == ["heading_not_asked"]
