"""Where live runs leave their files."""

import time
from pathlib import Path

from pdr_bringup_scripts.book import FILES
from pdr_core.evaluation.result import Result, in_words

RUNS = Path("pdr_runs")


def new_run_folder(name: str) -> Path:
    """Return a folder below the current one that no other run has."""
    return RUNS / f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"


def show_result(result: Result, folder: Path) -> None:
    """Say how the run went and where its files are."""
    print(in_words(result))
    print(f"Written to {folder}: recording (MCAP), {FILES}")
    print(f"Open {folder / 'report.html'} in a browser.")
