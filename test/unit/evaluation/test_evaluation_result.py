import json
import math

import numpy as np
import pytest

from pdr_core.evaluation.gait_totals import gait_totals
from pdr_core.evaluation.result import SensorsResult, in_words
from pdr_core.evaluation.score import TruthScore
from pdr_core.records import Level, Notice, TruthKind

KEYS = ["recording", "format", "samples", "duration_s", "rate_hz", "pipeline", "smoothed", "two_passes", "strides"]
KEYS += [
    "distance_m",
    "end_position_m",
    "closure_2d_m",
    "closure_3d_m",
    "seconds",
    "gait",
    "notices",
    "config",
    "truth",
]
KEYS += ["version", "commit"]


def strict(text):
    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    return json.loads(text, parse_constant=refuse)


def test_keys_and_values(make):
    content = strict(make.result_of().to_json())
    assert list(content) == KEYS
    assert content["rate_hz"] == 2.0
    assert content["end_position_m"] == [1.0, 2.0, 3.0]
    assert content["notices"] == [
        {"level": "WARN", "kind": "gap", "text": "The sensor was silent for 0.3 s", "count": 3}
    ]
    assert content["truth"] is None


def test_truth_of_positions_and_of_strides(make):
    score = TruthScore(TruthKind.POSITION, 0.05, 0.07, 0.4, 0.5)
    expected = {"kind": "position", "ate2_m": 0.05, "ate3_m": 0.07, "end_error_percent": 0.5}
    assert strict(make.result_of(truth=score).to_json())["truth"] == expected
    score = TruthScore(TruthKind.STRIDES, ate2_m=0.2, end_error_percent=1.0, stride_count_true=50, stride_ate2_m=0.2)
    expected = {"kind": "strides", "ate2_m": 0.2, "ate3_m": None, "end_error_percent": 1.0}
    expected |= {"stride_count_true": 50, "stride_ate2_m": 0.2}
    assert strict(make.result_of(truth=score).to_json())["truth"] == expected


def test_what_json_cannot_say_becomes_null(make):
    config = {
        "a": math.inf,
        "b": (1, np.nan),
        "c": np.float64("-inf"),
        "d": np.int64(3),
        "e": {"f": np.array([np.nan])},
    }
    result = make.result_of(duration_s=0.0, closure_2d_m=math.nan, end_position_m=np.full(3, np.nan), config=config)
    content = strict(result.to_json())
    assert content["config"] == {"a": None, "b": [1, None], "c": None, "d": 3, "e": {"f": [None]}}
    assert content["end_position_m"] == [None, None, None]
    assert content["closure_2d_m"] is None
    assert content["rate_hz"] is None


def test_a_configuration_that_is_no_json_is_an_error(make):
    with pytest.raises(TypeError):
        make.result_of(config={"a": object()}).to_json()


def test_several_sensors(make):
    both = SensorsResult("feet.mcap", "mcap", {"left": make.result_of(), "right": make.result_of(strides=1)})
    content = strict(both.to_json())
    assert list(content) == ["recording", "format", "sensors"]
    assert list(content["sensors"]["right"]) == KEYS
    assert content["sensors"]["right"]["strides"] == 1
    assert in_words(both).splitlines()[1].startswith("right: Walked 98.4 m in 1 stride ")


def test_words_without_truth(make):
    assert in_words(make.result_of()) == (
        "Walked 98.4 m in 52 strides within 1 min 40 s. The estimate ends 2.24 m from where it began; the true path is "
        "not known. Warning: The sensor was silent for 0.3 s (3 times)."
    )


def test_words_on_the_usual_stride(make):
    strides = make.strides_of(make.steps_at(np.cumsum(np.tile([1.4, 0.0, 0.17], (11, 1)), axis=0)))
    words = in_words(make.result_of(gait=gait_totals(strides, None)))
    assert " A stride was 1.40 m long at 100 steps a minute; stairs went 1.70 m up. " in words
    assert "A stride was" not in in_words(make.result_of(gait=gait_totals(strides[-1:], None)))


def test_a_smoothed_run_is_said_to_be_one_whatever_its_pipeline_is_called(make):
    assert strict(make.result_of(smoothed=True).to_json())["smoothed"] is True
    assert " within 1 min 40 s, smoothed. " in in_words(make.result_of(smoothed=True))
    assert "smoothed" not in in_words(make.result_of(pipeline="any, smoothed"))


def test_words_with_truth(make):
    score = TruthScore(TruthKind.POSITION, 0.05, 0.07, 0.42, 0.43)
    words = in_words(make.result_of(truth=score, notices=[]))
    assert words.endswith(
        "It was on average 0.05 m off the true path, and 0.42 m (0.4 % of the distance) off at the end."
    )
    score = TruthScore(TruthKind.STRIDES, 0.05, math.nan, 0.42, 0.43, stride_count_true=53, stride_ate2_m=0.05)
    assert "In truth there were 53 strides." in in_words(make.result_of(truth=score))
    score = TruthScore(TruthKind.CLOSED_LOOP, end_error_m=0.06, end_error_percent=0.24)
    assert "0.06 m (0.2 % of the distance) off at the end" in in_words(make.result_of(truth=score))
    assert "could not be compared" in in_words(make.result_of(truth=TruthScore(TruthKind.POSITION)))


def test_no_stride_is_no_success(make):
    score = TruthScore(TruthKind.POSITION, 0.0, 0.0, 0.0, math.nan)
    assert in_words(make.result_of(strides=0, distance_m=0.0, truth=score, notices=[])) == (
        "No stride was found within 1 min 40 s."
    )
    assert "Warning: The sensor was silent" in in_words(make.result_of(strides=0))


def test_an_unknown_share_of_the_distance_is_not_said(make):
    score = TruthScore(TruthKind.POSITION, 0.05, 0.07, 0.42, math.nan)
    assert in_words(make.result_of(truth=score, notices=[])).endswith("It was on average 0.05 m off the true path.")
    score = TruthScore(TruthKind.CLOSED_LOOP, end_error_m=0.06)
    assert in_words(make.result_of(truth=score, notices=[])).endswith("could not be compared with the true path.")


def test_the_worst_notice_comes_first_and_notes_stay_silent(make):
    notices = [
        Notice(Level.OK, "a", "Fine", 1, 0),
        Notice(Level.WARN, "b", "A gap.", 1, 0),
        Notice(Level.ERROR, "c", "The range was exceeded.", 1, 0),
    ]
    assert in_words(make.result_of(notices=notices)).endswith(" Error: The range was exceeded; 1 more warning.")
    assert "Fine" not in in_words(make.result_of(notices=notices[:1]))
    twice = [*notices, Notice(Level.ERROR, "d", "Is it mounted so?", 3, 0)]
    ending = " Error: The range was exceeded. Error: Is it mounted so? (3 times); 1 more warning."
    assert in_words(make.result_of(notices=twice)).endswith(ending)
    asked = in_words(make.result_of(notices=[Notice(Level.WARN, "e", "Is it the right point?", 1, 0)]))
    assert asked.endswith(" Warning: Is it the right point?")
    assert 2 <= in_words(make.result_of(notices=notices)).count(". ") + 1 <= 4
