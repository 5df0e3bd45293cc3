"""Heading observations: one for each step, at a stamp known before, whenever it comes."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from filter_cases import error_of, injected, judged, random_state, standing

from pdr_core.eskf import ZuptFilter, heading, position
from pdr_core.eskf.updates import correct_heading
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import HeadingObservation, HeadingSource, PositionError, joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.stance import StanceDetection

WALK = simulated_walk(SimulationParams(walk="straight", walk_length_m=4.8, sample_rate_hz=100.0))
ASKING = changed(Params(), "filter", heading_feedback=True)


def verdicts():
    stage = StanceDetection(ASKING.stance, ASKING.place)
    return joined([stage.run(WALK.imu), stage.finish()])


JUDGED = verdicts()


def observed(step, error_rad=0.1, sd_rad=0.05, later_ns=0):
    return HeadingObservation(
        step.index, step.stamp_ns, step.answer_due_ns + later_ns, HeadingSource.BUILDING, error_rad, sd_rad
    )


def empty(step):
    return HeadingObservation(step.index, step.stamp_ns, step.answer_due_ns, HeadingSource.NONE, 0.0, 0.0)


def asking():
    return ZuptFilter(ASKING.filter, ASKING.place)


def walked(answer, piece=10**9):
    """Run the walk in pieces; each step is answered when it comes out."""
    f, navs, steps = asking(), [], []
    for start in range(0, length(JUDGED), piece):
        nav, new = f.run(part(JUDGED, start, start + piece))
        while True:
            navs.append(nav)
            steps += new
            if not new:
                break
            for step in new:
                f.answer(answer(step))
            nav, new = f.resume()
    return f, joined(navs), steps


def test_a_filter_that_is_not_asked_to_does_not_ask():
    f = ZuptFilter(Params().filter, Params().place)
    nav, steps = f.run(JUDGED)
    assert length(nav) == length(JUDGED)
    assert steps
    assert all(step.answer_due_ns < 0 for step in steps)


def test_samples_wait_at_the_due_stamp_and_nothing_is_lost():
    f = asking()
    nav, (step,) = f.run(JUDGED)
    assert f.waits
    due = int(np.searchsorted(JUDGED.imu.stamp_ns, step.answer_due_ns))
    assert length(nav) == due < length(JUDGED)
    f.answer(empty(step))
    more, _ = f.resume()
    assert more.stamp_ns[0] == JUDGED.imu.stamp_ns[due]


def test_what_is_given_out_does_not_keep_the_room_for_what_waits():
    nav, _ = asking().run(JUDGED)
    assert length(nav) < length(JUDGED)
    assert all(column.base is None for column in nav)


def test_empty_answers_change_nothing():
    plain, _ = ZuptFilter(Params().filter, Params().place).run(JUDGED)
    _, nav, _ = walked(empty)
    for a, b in zip(nav, plain, strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("later_ns", [0, 150_000_000])
def test_late_and_early_answers_give_the_same_bits(later_ns):
    def answer(step):
        return observed(step, later_ns=later_ns)

    _, whole, steps = walked(answer)
    _, pieces, _ = walked(answer, piece=7)
    _, unanswered, _ = walked(empty)
    for a, b in zip(whole, pieces, strict=True):
        np.testing.assert_array_equal(a, b)
    first = int(np.searchsorted(whole.stamp_ns, steps[0].answer_due_ns + later_ns))
    assert np.array_equal(whole.quat_xyzw[:first], unanswered.quat_xyzw[:first])
    assert not np.allclose(whole.quat_xyzw[first], unanswered.quat_xyzw[first])


def test_the_pipeline_answers_as_the_nodes_do():
    chain = FootInertial(ASKING, heading=observed)
    nav = joined([chain.run(WALK.imu).nav, chain.finish().nav])
    pieces = FootInertial(ASKING, heading=observed)
    navs = [pieces.run(part(WALK.imu, i, i + 11)).nav for i in range(0, length(WALK.imu), 11)]
    for a, b in zip(nav, joined([*navs, pieces.finish().nav]), strict=True):
        np.testing.assert_array_equal(a, b)
    assert length(nav) == length(WALK.imu)
    plain = FootInertial(ASKING)
    assert length(joined([plain.run(WALK.imu).nav, plain.finish().nav])) == length(WALK.imu)


def test_answers_from_outside_give_what_answers_from_inside_do():
    chain, other = FootInertial(ASKING, heading=observed), FootInertial(ASKING, heading=None)
    inside = [chain.run(WALK.imu), chain.finish()]
    outside = [other.run(part(WALK.imu, i, i + 50)) for i in range(0, length(WALK.imu), 50)] + [other.finish()]
    asked = [step for output in outside for step in output.steps]
    for step in asked:
        outside.append(other.answer(observed(step)))
        asked += outside[-1].steps
    for name in ("judged", "nav"):
        whole, pieces = (joined([getattr(o, name) for o in made]) for made in (inside, outside))
        for a, b in zip(whole if name == "nav" else whole.imu, pieces if name == "nav" else pieces.imu, strict=True):
            np.testing.assert_array_equal(a, b)
    ends = [step.stamp_ns for output in inside for step in output.steps]
    assert [step.stamp_ns for output in outside for step in output.steps] == ends


def test_a_place_that_is_off_moves_and_its_noise_decides_how_far():
    off_m = np.array([0.3, -0.2, 0.1])

    def moved_m(sd_m):
        def answer(step):
            place = PositionError(off_m, np.eye(3) * sd_m**2)
            return replace(empty(step), position=place if step.index == 2 else None)

        (_, nav, steps), (_, plain, _) = walked(answer), walked(empty)
        after = int(np.searchsorted(nav.stamp_ns, steps[1].answer_due_ns))
        np.testing.assert_array_equal(nav.position_m[:after], plain.position_m[:after])
        assert np.linalg.eigvalsh(nav.pose_covariance[after])[0] > -1e-12
        return nav.position_m[after] - plain.position_m[after]

    np.testing.assert_allclose(moved_m(1e-6), -off_m, atol=0.005)  # one interval with the velocity that it corrects
    assert np.linalg.norm(moved_m(10.0)) < 1e-3


def test_the_error_of_a_place_is_truth_minus_estimate():
    state = random_state(np.random.default_rng(4))
    truth = injected(state, error := np.random.default_rng(5).normal(0.0, 1e-6, 15))
    given_m = state.position_m - truth.position_m
    np.testing.assert_allclose(position.H @ error, position.residual(given_m), atol=1e-12)


def test_giving_up_goes_on_and_says_so():
    f = asking()
    f.run(JUDGED)
    f.give_up_answers()
    nav, _ = f.resume()
    assert length(nav)
    assert [(n.kind, n.count) for n in f.notices] == [("heading_unanswered", 1)]


def test_giving_one_answer_up_leaves_the_others_their_time():
    f = ZuptFilter(changed(ASKING, "filter", heading_due_s=2.0).filter, ASKING.place)
    _, steps = f.run(JUDGED)
    assert len(steps) > 1
    f.give_up_answers()
    f.answer(observed(steps[1]))
    assert [(n.kind, n.count) for n in f.notices] == [("heading_unanswered", 1)]


@pytest.mark.parametrize(
    ("wrong", "kind"),
    [
        ({"step_index": 99}, "heading_unasked"),
        ({"step_ns": 5}, "heading_unasked"),
        ({"yaw_error_rad": np.nan}, "heading_unusable"),
        ({"yaw_error_sd_rad": np.inf}, "heading_unusable"),
        ({"yaw_error_sd_rad": 0.0}, "heading_unusable"),
        ({"applies_from_ns": 5}, "heading_unusable"),
        ({"position": PositionError(np.array([0.0, np.nan, 0.0]), np.eye(3))}, "heading_unusable"),
        ({"position": PositionError(np.zeros(3), np.diag([1.0, -1.0, 1.0]))}, "heading_unusable"),
    ],
)
def test_a_wrong_answer_is_named_and_turns_nothing(wrong, kind):
    f = asking()
    _, (step,) = f.run(JUDGED)
    before = f.state.quat_xyzw.copy()
    f.answer(replace(observed(step), **wrong))
    assert [(n.kind, n.count) for n in f.notices] == [(kind, 1)]
    if kind == "heading_unasked":
        assert f.waits
        return
    other = asking()
    other.run(JUDGED)
    other.answer(empty(step))
    (a, _), (b, _) = f.resume(), other.resume()
    np.testing.assert_array_equal(a.quat_xyzw, b.quat_xyzw)
    assert not np.array_equal(before, f.state.quat_xyzw)


def test_only_the_first_answer_counts():
    f = asking()
    _, (step,) = f.run(JUDGED)
    f.answer(empty(step))
    f.answer(observed(step))
    assert [n.kind for n in f.notices] == ["heading_unasked"]


def test_a_clock_that_jumps_back_leaves_nobody_waiting_for_its_future():
    f = asking()
    _, (step,) = f.run(JUDGED)
    f.answer(observed(step, later_ns=50_000_000_000))
    f.resume()
    for _ in range(2):
        f.give_up_answers()
        f.resume()
    early = JUDGED._replace(imu=JUDGED.imu._replace(stamp_ns=JUDGED.imu.stamp_ns - 10**13))
    _, steps = f.run(early)
    assert f._answers.next_ns <= max(s.answer_due_ns for s in steps)


def test_a_reset_forgets_what_was_asked():
    f = asking()
    f.run(JUDGED)
    f.reset(f.handover)
    nav, _ = f.run(part(JUDGED, 0, 20))
    assert not f.waits
    assert length(nav) == 20


def test_another_filter_goes_on_from_a_handover():
    f, other = asking(), asking()
    f.run(JUDGED)
    handed = f.handover
    other.reset(handed)
    other.run(judged(standing(0.05), np.ones(10, bool)))
    np.testing.assert_array_equal(other.state.position_m, handed.pose.position_m)
    np.testing.assert_array_equal(other.state.gyro_bias_radps, handed.biases.gyro_radps)
    assert other.health.yaw_sd_rad == pytest.approx(f.health.yaw_sd_rad)
    np.testing.assert_allclose(other.health.gyro_bias_sd_radps, f.health.gyro_bias_sd_radps)


def test_each_step_hands_over_the_same_in_whatever_pieces_the_samples_come():
    def handed(piece):
        f, found = ZuptFilter(Params().filter, Params().place), []
        for start in range(0, length(JUDGED), piece):
            f.run(part(JUDGED, start, start + piece))
            found += f.handovers
        f.finish()
        return found + f.handovers

    whole, single = handed(10**9), handed(1)
    assert len(whole) == len(single) == 4
    for one, other in zip(whole, single, strict=True):
        assert one.stamp_ns == other.stamp_ns
        np.testing.assert_array_equal(one.pose.position_m, other.pose.position_m)
        np.testing.assert_array_equal(one.pose.covariance, other.pose.covariance)


def test_the_jacobian_of_a_heading_observation_is_right():
    rng = np.random.default_rng(3)
    for state in (random_state(rng) for _ in range(5)):
        for i in range(15):
            error = np.zeros(15)
            error[i] = 1e-5
            truth = injected(state, error)
            turned = error_of(state, truth)[8]
            assert turned / 1e-5 == pytest.approx(heading.H[0, i], abs=1e-4)


def test_a_sure_observation_turns_the_track_back():
    state = random_state(np.random.default_rng(4))
    before = copy.deepcopy(state)
    correct_heading(0.02, 1e-6, state)
    assert error_of(before, state)[8] == pytest.approx(-0.02, abs=1e-4)
    assert state.P[8, 8] == pytest.approx(1e-12, rel=0.01)
