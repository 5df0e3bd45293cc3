import json
import re

import numpy as np
import pytest

from pdr_core.evaluation import mag_plots
from pdr_core.evaluation.mag_page import FieldView, mag_page
from pdr_core.evaluation.report import Card

RNG = np.random.default_rng(0)
DIRECTION = RNG.standard_normal((9000, 3))
AFTER = 50e-6 * DIRECTION / np.linalg.norm(DIRECTION, axis=1, keepdims=True)
BEFORE = AFTER * [1.1, 0.9, 1.0] + [10e-6, 0.0, -20e-6]
VIEW = FieldView(10**18 + np.arange(9000) * 10_000_000, BEFORE, AFTER, 50e-6)


@pytest.fixture(scope="module")
def text():
    return mag_page("</script>turned.mcap", "Well & done.", [Card("50.0 µT", "strength")], VIEW, "1.2.3")


def test_the_page_says_what_was_found_and_needs_nothing_else(text):
    assert "&lt;/script&gt;turned.mcap" in text
    assert "Well &amp; done." in text
    assert "<b>50.0 µT</b><span>strength</span>" in text
    assert "pdr 1.2.3" in text
    assert not re.search(r'(src|href)="', text.split("<script>", maxsplit=1)[0])
    assert '<script src="' not in text


def test_the_pictures_are_on_the_page(text):
    figures = [json.loads(one) for one in re.findall(r"const figure = (.*);", text)]
    kinds = [{trace["type"] for trace in figure["data"]} for figure in figures]
    assert kinds == [{"scatter3d"}, {"scatter"}]


def test_the_clouds_are_in_microtesla_beside_their_sphere():
    fig = mag_plots.spheres(BEFORE, AFTER, 50e-6)
    before, after = (t for t in fig.data if t.mode == "markers")
    assert (before.scene, after.scene) == ("scene", "scene2")
    for cloud, field in ((before, BEFORE), (after, AFTER)):
        points = np.column_stack([cloud.x, cloud.y, cloud.z]).astype(float)
        np.testing.assert_allclose(points, field[::3] * 1e6, rtol=1e-3)
    for sphere in (t for t in fig.data if t.mode == "lines"):
        lines = np.array([sphere.x, sphere.y, sphere.z], float)
        np.testing.assert_allclose(np.linalg.norm(lines[:, np.isfinite(lines[0])], axis=0), 50.0, rtol=1e-3)
        assert np.isnan(lines[0]).sum() > 10


def test_the_strength_is_drawn_before_and_after():
    fig = mag_plots.strength(np.arange(9000) * 0.01, BEFORE, AFTER, 50e-6)
    before, after, level = fig.data
    assert np.ptp(before.y) > 20.0
    np.testing.assert_allclose(after.y, 50.0, rtol=1e-3)
    assert list(level.y) == [50.0, 50.0]
