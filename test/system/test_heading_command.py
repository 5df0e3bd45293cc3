"""The heading constraint as users switch it on, and the comparison of all of them."""

import json
from pathlib import Path

import pytest

from support.processes import check_refused, pdr
from support.walks import straight_walk, write_csv


@pytest.fixture(scope="module")
def walk(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_csv(tmp_path_factory.mktemp("walk") / "walk.csv", straight_walk(12).imu)


def test_run_takes_the_constraint_by_option_or_by_parameters(walk: Path, tmp_path: Path) -> None:
    file = tmp_path / "params.yaml"
    file.write_text(pdr("params").stdout.replace("constraint: 'none'", "constraint: 'dominant'"))
    for options in (("--heading", "dominant"), ("--params", file)):
        found = json.loads(pdr("run", walk, "--json", *options).stdout)
        assert found["config"]["heading"]["constraint"] == "dominant"
        assert {n["kind"] for n in found["notices"]} >= {"heading_on", "heading_held"}


def test_what_cannot_be_had_is_said(walk: Path) -> None:
    check_refused(pdr("run", walk, "--heading", "walls"), "heading.constraint = 'walls'", "dominant, hde")
    check_refused(pdr("run", walk, "--heading", "hde", "--smooth"), "--smooth", "leave out --smooth or --heading")
    check_refused(pdr("compare", walk, "--headings", "walls"), "--headings walls", "dominant, hde")
    check_refused(pdr("compare", walk, "--headings", "all", "--orientations", "all"), "one at a time")


def test_compare_shows_every_constraint(walk: Path, tmp_path: Path) -> None:
    run = pdr("compare", walk, "--headings", "dominant,learned", "--out", tmp_path / "page")
    assert run.returncode == 0, run.stderr
    for text in ("ZUPT alone", "with the bias of the first rest", "with ZARU in later rests", "dominant", "learned"):
        assert text in run.stdout
    assert "hde" not in run.stdout
    assert "Where the walk went" in (tmp_path / "page" / "headings.html").read_text()
    (found,) = json.loads((tmp_path / "page" / "headings.json").read_text())
    assert found["scores"]["dominant"]["held"] > 0
