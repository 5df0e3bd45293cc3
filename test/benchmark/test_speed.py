"""How fast: samples per second of each stage in one thread, and how long a start takes. `-s` shows the figures.

Absolute limits are asserted in `pdr test --full` alone, where nothing else should run on the machine.
"""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from pdr_core.recording import open_recording
from pdr_core.records import joined, length
from pdr_core.warmup import warm_up
from support.stopwatch import Stopwatch, samples_per_s, timed
from support.walks import straight_walk, write_csv

CHECKOUT = Path(__file__).resolve().parents[2]
OFFLINE_LIMIT = 200_000  # samples/s
SECOND_START_LIMIT_S = 2.0
full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


def show(speeds: dict[str, float]) -> None:
    for name, speed in speeds.items():
        print(f"\n{name:<14}{speed:>12,.0f} samples/s = {speed / OFFLINE_LIMIT:6.2f} of the limit", end="")


def test_every_stage_can_be_timed() -> None:
    walk = straight_walk(10, 200.0).imu
    watch = Stopwatch()
    warm_up()
    assert timed(walk, watch) == length(walk)
    show({name: length(walk) / seconds for name, seconds in watch.seconds.items()})
    assert list(watch.seconds) == ["intake", "stance", "filter", "all together"]


@full
def test_offline_speed(recordings: Path) -> None:
    sessions = [open_recording(path) for path in sorted((recordings / "pyshoe_vicon").glob("*.mat"))]
    walks = [joined(list(sensor.pieces())) for session in sessions for sensor in session.sensors.values()]
    speeds = samples_per_s(walks, rounds=7)
    show(speeds)
    assert speeds["all together"] >= OFFLINE_LIMIT


@full
def test_second_start(tmp_path: Path) -> None:
    walk = write_csv(tmp_path / "walk.csv", straight_walk(20, 200.0).imu)
    command = [str(CHECKOUT / "pdr_bringup_scripts" / "pdr"), "run", str(walk), "--json"]
    starts = [process_s(command) for _ in range(6)][1:]  # the first one may compile
    (best, busy), (worst, _) = min(starts), max(starts)
    share = f"{best / SECOND_START_LIMIT_S:.2f} of the limit"
    print(f"\nsecond start {best:.2f} .. {worst:.2f} s = {share}, {busy:.2f} s of it computing", end="")
    assert best <= SECOND_START_LIMIT_S


@full
def test_first_compile(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "pdr_core.warmup"]
    (first, first_busy), (second, second_busy) = (process_s(command, PDR_CACHE=str(tmp_path)) for _ in range(2))
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    size_mb = sum(path.stat().st_size for path in files) / 1e6
    print(f"\nfirst compile {first:.1f} s, {first_busy:.1f} s of it computing", end="")
    print(f"; loaded again {second:.2f} s ({second_busy:.2f} s), {len(files)} files of {size_mb:.1f} MB", end="")
    assert files, "nothing is kept: every start compiles"


def process_s(command: list[str], **environment: str) -> tuple[float, float]:
    """Return the time [s] that a fresh process takes, and how much of it [s] it computes: the rest it waits."""
    begin, before = time.perf_counter(), os.times()
    subprocess.run(command, env=os.environ | environment, check=True, capture_output=True, timeout=600)
    after = os.times()
    busy_s = after.children_user + after.children_system - before.children_user - before.children_system
    return time.perf_counter() - begin, busy_s
