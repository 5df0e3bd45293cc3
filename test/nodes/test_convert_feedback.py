"""What estimators ask, answer and hand to each other survives the way through messages."""

from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest

from pdr_core.conventions import NO_STAMP
from pdr_core.records import (
    Biases,
    Handover,
    HeadingObservation,
    HeadingSource,
    PoseEstimate,
    PositionError,
    StepEvent,
)
from pdr_msgs.msg import HeadingObservation as HeadingMessage
from pdr_nodes.convert import step_event, step_message
from pdr_nodes.convert_feedback import handover_message, handover_record, heading_message, heading_observation

STAMP = 1_700_000_000_123_456_789
RNG = np.random.default_rng(1)


def assert_equal(a, b):
    assert type(a) is type(b)
    if is_dataclass(a):
        for field in fields(a):
            assert_equal(getattr(a, field.name), getattr(b, field.name))
    else:
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("due_ns", [STAMP + 5, NO_STAMP])
def test_a_step_keeps_when_its_answer_is_due(due_ns):
    step = StepEvent(3, STAMP - 10**9, STAMP, RNG.random(3), RNG.random(3), np.eye(3), 0.3, 0.1, due_ns)
    assert_equal(step_event(step_message(step, "odom", "foot")), step)
    placed = replace(step, position_covariance_m2=RNG.random((3, 3)))
    assert_equal(step_event(step_message(placed, "odom", "foot")), placed)


@pytest.mark.parametrize("source", HeadingSource)
def test_an_answer(source):
    answer = HeadingObservation(3, STAMP, STAMP + 7, source, -0.2, 0.05)
    assert_equal(heading_observation(heading_message(answer, "foot")), answer)
    placed = replace(answer, position=PositionError(RNG.random(3), RNG.random((3, 3))))
    assert_equal(heading_observation(heading_message(placed, "foot")), placed)


def test_an_answer_of_an_unknown_source_is_one():
    assert heading_observation(HeadingMessage(source=99)).source is HeadingSource.EXTERNAL


@pytest.mark.parametrize("biases", [None, Biases(RNG.random(3), RNG.random(3), RNG.random((6, 6)))])
@pytest.mark.parametrize("attitude", [True, False])
def test_a_handover(biases, attitude):
    quat = np.array([0.5, -0.5, 0.5, 0.5]) if attitude else None
    handover = Handover(STAMP, PoseEstimate(RNG.random(3), quat, np.eye(6) * 0.1), biases)
    assert_equal(handover_record(handover_message(handover, "odom", "foot")), handover)
