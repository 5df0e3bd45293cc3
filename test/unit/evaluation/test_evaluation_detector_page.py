"""Tables and page of compared detectors, from made-up studies."""

import csv
import io
import json
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from pdr_core.evaluation import detector_plots
from pdr_core.evaluation.detector_curves import detector_curves, true_speed
from pdr_core.evaluation.detector_page import detector_page
from pdr_core.evaluation.detector_study import Choice, DetectorStudy, WindowSteps
from pdr_core.evaluation.detector_tables import as_csv, as_json, figures, summaries, worth
from pdr_core.evaluation.score import Scorer
from pdr_core.evaluation.walk_score import WalkScore, walk_score
from pdr_core.records import Truth, TruthKind

NAN = float("nan")
UNKNOWN = WalkScore("none", 26, None, NAN, NAN, NAN, NAN, NAN, 0.4)


@pytest.fixture(scope="module")
def studies(make):
    """Two recordings, one with its true path and one with its true strides; two detectors with two gates."""
    walk = make.rectangle()
    found = []
    for name, truth in {
        "</script>room": Truth(TruthKind.POSITION, walk.stamp_ns, walk.true_m),
        "tiles": Truth(TruthKind.STRIDES, np.empty(0, np.int64), walk.footfall_m),
    }.items():
        scorer = Scorer(truth)
        scorer.add(walk.nav)
        score = walk_score(scorer, walk.steps, walk.judged.stance)
        gates = {"none": walk.judged, "gait_phases": walk.judged}
        found.append(
            DetectorStudy(
                name,
                {Choice(detector, gate): score for detector in ("adaptive", "glrt") for gate in gates},
                [detector_curves(detector, gates) for detector in ("adaptive", "glrt")],
                true_speed(truth, int(walk.stamp_ns[0])),
                WindowSteps(np.array([0.005, 0.1, 0.25]), {"adaptive": [90, 26, 0], "glrt": [26, 26, 20]}),
                {"nothing": score, "confidence": score},
            )
        )
    return found


def pictures_in(text):
    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    data = re.findall(r'<script type="application/json">(.*)</script>', text)
    assert not any("<" in one for one in data)  # could end the script
    return [json.loads(one, parse_constant=refuse) for one in data]


def test_the_page_stands_alone_and_holds_every_picture(studies):
    text = detector_page(studies, "1.0", "abc")
    assert re.findall(r'(?:src|href)="', text.split("<script>")[0]) == []
    assert [f'id="{kind}-{i}"' in text for i in (0, 1) for kind in ("detectors", "windows")] == [True] * 4
    first, windows, second, _ = pictures_in(text)
    titles = [[title["text"] for title in one["layout"]["annotations"]] for one in (first, second)]
    assert titles == [["Speed of the foot in truth", "adaptive", "glrt"], ["adaptive", "glrt"]]  # no path, no speed
    assert [line["name"] for line in windows["data"]] == ["adaptive", "glrt"]
    assert len(text) < 7_000_000


def test_what_the_page_says(studies):
    text = detector_page(studies, "1.0", "abc")
    for words in ("2 detectors on 2 recordings", "switched off", "confidence", "gait_phases", "26 of 26", "commit abc"):
        assert words in text
    assert "&lt;/script&gt;room" in text
    assert "</script>room" not in text
    assert re.search(r"The mean error is least with \w+: 0\.\d\d m", text)
    assert "All figures" in text
    assert "All figures" not in detector_page(studies[:1], "1.0", "abc")


def test_every_detector_has_a_row_with_statistic_threshold_and_a_lane_for_each_gate(studies):
    drawn = detector_plots.detectors(studies[0].curves, studies[0].speed)
    names = [line.name for line in drawn.data]
    lanes = ["Stance, gate none", "Stance, gate gait phases"]
    assert names == ["True speed", *[*lanes, "Statistic", "Threshold"] * 2]
    assert [line.showlegend for line in drawn.data[1:]] == [True] * 4 + [False] * 4
    upper, lower = (np.array(drawn.data[i].y[:4]) for i in (1, 2))
    assert (upper.min(), upper.max(), lower.min(), lower.max()) == (0.5, 1.0, 0.0, 0.5)
    assert len({line.xaxis for line in drawn.data}) == 3
    shared = {drawn.layout[f"xaxis{i}"].matches for i in ("", "2", "3")}
    assert shared == {"x3", None}


def test_the_true_count_is_a_line_where_it_is_known(studies):
    drawn = [detector_plots.windows(s.windows, s.strides_true) for s in studies]
    assert [line.name for line in drawn[0].data] == ["adaptive", "glrt"]
    assert [line.name for line in drawn[1].data] == ["adaptive", "glrt", "In truth"]
    assert list(drawn[1].data[2].y) == [26.0, 26.0]
    assert list(drawn[0].data[0].y) == [90.0, 26.0, None]  # a logarithm has no zero


def test_tables_leave_out_what_nobody_knows(studies):
    heads = ("recording", "detector", "gate", "strides", "ATE2 m", "ATE3 m", "at strides m", "stance %")
    assert figures(studies).heads == heads
    assert [row[:3] for row in figures(studies).rows][:2] == [
        ("</script>room", "adaptive", ""),
        ("</script>room", "adaptive", "gait_phases"),
    ]
    assert figures(studies[1:]).heads == ("detector", "gate", "strides", "at strides m", "stance %")
    assert summaries(studies).heads[-3:] == ("worst m", "over 1 m", "strides wrong")
    assert [row[0] for row in worth(studies).rows] == ["nothing", "confidence"]
    assert worth([SimpleNamespace(ablation={})]).rows == []


def test_no_table_has_names_alone(studies):
    nobody = [replace(s, scores=dict.fromkeys(s.scores, UNKNOWN), ablation={}) for s in studies]
    assert summaries(nobody).rows == worth(nobody).rows == []
    assert figures(nobody).heads == ("recording", "detector", "gate", "strides", "stance %")
    text = detector_page(nobody, "1.0", "abc")
    assert ("All figures" in text, "Each detector over" in text) == (True, False)


def test_the_worth_of_parts_comes_from_the_recordings_that_tell_it(studies):
    assert worth([replace(studies[0], ablation={}), *studies[1:]]) == worth(studies[1:])


def test_machines_get_every_figure(studies):
    found = json.loads(as_json(studies))
    assert set(found) == {"figures", "summary", "windows", "ablation"}
    assert len(found["figures"]) == 8
    assert found["figures"][0]["strides_true"] is None
    assert found["figures"][-1]["strides_true"] == 26
    assert found["summary"][0] | {"detector": "adaptive", "gate": "none", "recordings": 2} == found["summary"][0]
    assert found["windows"][0]["steps"]["glrt"] == [26, 26, 20]
    assert [row["switched_off"] for row in found["ablation"]] == ["nothing", "confidence"]
    lines = list(csv.DictReader(io.StringIO(as_csv(studies))))
    assert [line["recording"] for line in lines] == [row["recording"] for row in found["figures"]]
    assert float(lines[0]["ate2_m"]) == found["figures"][0]["ate2_m"]
    assert lines[0]["stride_ate2_m"] == ""
