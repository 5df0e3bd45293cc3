"""Style and types, with the settings at the root of the checkout."""

import subprocess
import sys

import pytest
from source_tree import CHECKOUT


@pytest.mark.parametrize("tool", ["ruff check", "ruff format --check", "mypy"])
def test_style_and_types(tool):
    run = subprocess.run([sys.executable, "-m", *tool.split()], cwd=CHECKOUT, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
