import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from pdr_core.evaluation import plots, style
from pdr_core.evaluation.plan import plan
from pdr_core.evaluation.report import report, write_report
from pdr_core.evaluation.score import Scorer
from pdr_core.evaluation.trace import Trace
from pdr_core.records import Level, Notice, Truth, TruthKind, part

NO_STAMPS = np.empty(0, dtype=np.int64)
GAIT = ["lengths", "pitch", "climb", "heading", "velocity"]
FIGURES = ["plan", "stance", "height", "error", "strides", *GAIT]


class Page(HTMLParser):
    """The tags that load something, the ids, and the words outside of scripts and styles."""

    def __init__(self, text):
        super().__init__()
        self.loads, self.ids, self.words, self._skip = [], [], "", False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        names = dict(attrs)
        self._skip = tag in ("script", "style")
        self.ids += [names["id"]] if "id" in names else []
        self.loads += [(tag, names[key]) for key in ("src", "href", "srcset", "data", "action") if key in names]

    def handle_endtag(self, _tag):
        self._skip = False

    def handle_data(self, data):
        self.words += "" if self._skip else data


def figures_in(text):
    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    return [json.loads(line, parse_constant=refuse) for line in re.findall(r"const figure = (.*);\n", text)]


def run(make, kind=None, limit=20_000):
    """The walk round the rectangle with its trace and its view of the truth."""
    walk = make.rectangle()
    truth = {
        None: None,
        TruthKind.POSITION: Truth(TruthKind.POSITION, walk.stamp_ns, walk.true_m),
        TruthKind.STRIDES: Truth(TruthKind.STRIDES, NO_STAMPS, walk.footfall_m),
        TruthKind.CLOSED_LOOP: Truth(TruthKind.CLOSED_LOOP, NO_STAMPS, np.empty((0, 3))),
    }[kind]
    scorer, trace = Scorer(truth), Trace(limit)
    scorer.add(walk.nav)
    trace.add(walk.judged, walk.nav)
    start_m = walk.nav.position_m[0]
    result = make.result_of(truth=scorer.score(walk.steps, start_m), strides=len(walk.steps))
    return result, trace, walk.strides, scorer.view(walk.steps, start_m)


@pytest.mark.parametrize("kind", [None, *TruthKind])
def test_the_file_stands_alone_and_holds_every_figure(make, tmp_path, kind):
    path = tmp_path / "report.html"
    write_report(path, *run(make, kind))
    text = path.read_text(encoding="utf-8")
    page = Page(text)
    assert page.loads == []
    assert "@import" not in text.split("</style>")[0]
    assert text.count("<script>") == 2
    assert page.ids == FIGURES
    assert len(figures_in(text)) == len(FIGURES)
    assert not any("<" in line for line in re.findall(r"const figure = .*;\n", text))  # could end the script
    assert path.stat().st_size < 6_000_000


def test_the_words_on_the_page(make):
    words = Page(report(*run(make, TruthKind.POSITION))).words
    for said in ("Walked 98.4 m in 26 strides", "stance.window_s", "0.035", "Warning", "3 times", "0123abc", "ATE2"):
        assert said in words


def test_what_others_wrote_cannot_become_markup(make):
    evil = "</script><img src=x onerror=alert(1)>"
    _, *rest = run(make)
    result = make.result_of(recording=evil, notices=[Notice(Level.WARN, "a", evil, 1, 0)], config={evil: evil})
    page = Page(report(result, *rest))
    assert page.loads == []
    assert page.words.count(evil) >= 4


def test_without_notices_strides_or_samples(make):
    result, trace, _, _ = run(make)
    page = Page(report(make.result_of(notices=[]), trace, [], None))
    assert "Nothing unusual happened" in page.words
    assert page.ids == FIGURES[:4]
    assert Page(report(result, Trace(), [], None)).ids == []


def test_a_long_walk_stays_a_small_file(make):
    n = 90_000
    rng = np.random.default_rng(2)
    stamps = np.arange(n) * 5_000_000
    track_m = np.cumsum(rng.normal(0, 0.01, (n, 3)), axis=0)
    stance = np.arange(n) % 200 < 100
    nav = make.nav_block(stamps, track_m, 0.0, np.eye(3) * 1e-4)
    judged = make.stance_block(stamps, stance, rng.exponential(100, n))
    scorer, trace = Scorer(Truth(TruthKind.POSITION, stamps, track_m + rng.normal(0, 0.01, (n, 3)))), Trace()
    for i in range(0, n, 30_000):
        scorer.add(part(nav, i, i + 30_000))
        trace.add(part(judged, i, i + 30_000), part(nav, i, i + 30_000))
    steps = make.steps_at(track_m[100::200], stamps[100::200])
    text = report(make.result_of(), trace, make.strides_of(steps), scorer.view(steps, track_m[0]))
    assert len(text.encode()) < 6_000_000
    assert len(trace.stance_intervals_s) == 450


def test_the_plan_has_equal_axes_and_every_part(make):
    _, trace, strides, view = run(make, TruthKind.POSITION)
    steps = [stride.step for stride in strides]
    figure = plan(trace, steps, view)
    lines = {line.name: line for line in figure.data}
    assert set(lines) == {"Uncertainty (1 σ)", "Truth", "Estimate", "Footfalls", "Start", "End"}
    assert (figure.layout.yaxis.scaleanchor, figure.layout.yaxis.scaleratio) == ("x", 1)
    np.testing.assert_allclose(lines["Truth"].x, view.truth_m[:, 0], atol=1e-4)
    assert len(lines["Footfalls"].x) == len(steps)
    assert (lines["End"].x[0], lines["End"].y[0]) == pytest.approx(tuple(trace.points.position_m[-1, :2]), abs=1e-4)


def test_an_ellipse_reaches_one_deviation_along_its_larger_axis(make):
    _, trace, strides, view = run(make, TruthKind.POSITION)
    steps = [stride.step for stride in strides]
    outline = plan(trace, steps, view).data[0]
    last_m = np.column_stack([outline.x[-34:-1], outline.y[-34:-1]]).astype(float)
    reach_m = np.linalg.norm(last_m - steps[-1].position_m[:2], axis=1).max()
    assert reach_m == pytest.approx(trace.points.horizontal_sd_m[-1], rel=1e-2)


def test_the_stances_are_shaded_below_a_logarithmic_axis(make):
    _, trace, _, _ = run(make)
    shade, statistic, threshold = plots.stance(trace).data
    assert shade.x[:6] == (0.0, 0.0, 0.5, 0.5, 0.0, 0.0)
    assert shade.y[:6] == (0.0, 1.0, 1.0, 0.0, 0.0, None)
    assert len(shade.x) == 6 * 27
    assert plots.stance(trace).layout.yaxis2.type == "log"
    assert (statistic.yaxis, threshold.yaxis) == ("y2", "y2")


def test_a_dropout_leaves_a_gap_in_the_error(make):
    walk = make.rectangle()
    true_m = walk.true_m.copy()
    true_m[500:520] = true_m[500]
    scorer = Scorer(Truth(TruthKind.POSITION, walk.stamp_ns, true_m))
    scorer.add(walk.nav)
    horizontal = plots.error(scorer.view(walk.steps, np.zeros(3))).data[0]
    assert set(horizontal.y[500:520]) == {None}
    assert None not in horizontal.y[:500]


def test_the_error_of_strides_goes_over_strides_and_has_no_height(make):
    *_, view = run(make, TruthKind.STRIDES)
    figure = plots.error(view)
    assert [line.name for line in figure.data] == ["Horizontal error"]
    assert figure.data[0].x == tuple(range(27))
    assert figure.layout.xaxis.title.text == "Stride"


def test_the_heading_does_not_jump_at_half_a_turn(make):
    *_, strides, _ = run(make)
    heading_deg = plots.strides([stride.step for stride in strides]).data[1].y
    assert heading_deg[-1] == pytest.approx(270, abs=5)
    assert np.abs(np.diff(heading_deg)).max() < 95


def test_numbers_for_the_page_are_short_and_never_nan():
    assert style.listed(np.array([1.23456789, np.nan, -np.inf, 2.5e-7])) == [1.23457, None, None, 2.5e-7]
