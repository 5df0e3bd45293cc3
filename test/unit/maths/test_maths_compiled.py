"""The cache of compiled code: a change is seen by all that depend on it, and by nothing else."""

import shutil
from pathlib import Path

import pytest

from pdr_core.maths import compiled

FILTER, REST, VECTOR = "pdr_core.eskf.navigate", "pdr_core.stance.rest", "pdr_core.maths.vector"


@pytest.fixture
def copy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(compiled.PACKAGES / "pdr_core", tmp_path / "pdr_core")
    monkeypatch.setattr(compiled, "PACKAGES", tmp_path)
    forget()
    yield tmp_path / "pdr_core"
    forget()


def forget() -> None:
    for function in (compiled.source, compiled.imported, compiled.cache_folder):
        function.cache_clear()


def moved_by_a_change_of(path: Path) -> set[str]:
    """Append to a file and return whose compiled code is thereby out of date."""
    before = {module: compiled.cache_folder(module) for module in (FILTER, REST, VECTOR)}
    path.write_text(path.read_text() + "\n# changed\n")
    forget()
    return {module for module, folder in before.items() if compiled.cache_folder(module) != folder}


@pytest.mark.parametrize(
    ("file", "moved"),
    [
        ("maths/vector.py", {FILTER, REST, VECTOR}),
        ("maths/compiled.py", {FILTER, REST, VECTOR}),
        ("conventions.py", {FILTER, REST, VECTOR}),
        ("stance/rest.py", {REST}),
        ("eskf/zupt.py", {FILTER}),  # named as `from pdr_core.eskf import zupt`
        ("maths/levelling.py", {FILTER}),  # two imports away
        ("params.py", set()),
        ("evaluation/score.py", set()),
    ],
)
def test_a_change_reaches_what_depends_on_it(copy: Path, file: str, moved: set[str]) -> None:
    assert moved_by_a_change_of(copy / file) == moved


def test_modules_share_no_folder() -> None:
    assert len({compiled.cache_folder(module) for module in (FILTER, REST, VECTOR)}) == 3


def test_what_is_not_ours_has_no_source() -> None:
    assert compiled.source("numpy") is None
