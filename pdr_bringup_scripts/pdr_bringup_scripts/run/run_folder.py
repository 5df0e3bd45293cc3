"""Where runs leave their files."""

import time
from pathlib import Path

from pdr_bringup_scripts.run.body_book import FILES as BODY_FILES
from pdr_bringup_scripts.run.book import FILES
from pdr_bringup_scripts.run.known_points import ON_MAP
from pdr_core.evaluation.result import Result, SensorsResult, in_words
from pdr_core.pipeline.both_feet import BODY

RUNS = Path("pdr_runs")


def new_run_folder(name: str) -> Path:
    """Return a folder below the current one that no other run has."""
    return RUNS / f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"


def show_calls(result: Result | SensorsResult) -> None:
    """Say what the driver was asked, and what it has answered, where the gyro was switched."""
    if isinstance(result, SensorsResult) or result.saving is None:
        return
    for row in result.saving.rows():
        print(f"{row.when:>10}  {row.what:<18}  {row.answer:<38}  {row.why}")


def files_of(result: Result | SensorsResult) -> str:
    """Return what a run has left in its folder."""
    if not isinstance(result, SensorsResult):
        return f"{FILES}{on_map(result)}"
    map_file = on_map(result.body)
    body = f"; in {BODY}: {BODY_FILES}{map_file}" if result.body else ""
    return f"result.json; in {', '.join(result.sensors)}: {FILES}{map_file}{body}"


def on_map(result: Result | None) -> str:
    """Return what a run has left beside, where somebody said where the track lies."""
    return f", {ON_MAP}" if result and result.external and result.external.comparison.frame else ""


def say(result: Result | SensorsResult, out: Path | None, json: bool) -> None:
    """Say how the run went, as JSON or in words with where its files are."""
    print(result.to_json() if json else in_words(result))
    if out and not json:
        print(f"Written to {out}: {files_of(result)}")


def show_result(result: Result | SensorsResult, folder: Path) -> None:
    """Say how the run went and where its files are."""
    print(in_words(result))
    print(f"Written to {folder}: recording (MCAP), {files_of(result)}")
    of = folder / BODY if isinstance(result, SensorsResult) else folder
    print(f"Open {of / 'report.html'} in a browser.")
