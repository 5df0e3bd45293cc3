"""How far off the real recordings come out, through the way that users take; `-s` shows the table."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from pdr_bringup_scripts.run.run_choice import each_estimated
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_core.evaluation.metrics import path_length_m
from pdr_core.evaluation.result import Result, SensorsResult
from pdr_core.params import Params
from pdr_core.recording import open_recording
from pdr_core.recording.tum import Trajectory, read_tum
from pdr_core.records import length

FOLDERS = {
    "pyshoe_vicon": ("*.mat", 28),
    "tile_walks_marg": ("*.csv", 5),
    "xio_ngimu": ("*.csv", 1),
    "xio_ximu_marg": ("*.csv", 2),
    "ros1_foot_imu": ("*.csv", 1),
    "gaitmap_dual_foot": ("imu_sample.csv", 1),
}
ROW = "{:<22}{:<42}{:>8}{:>9}{:>8}{:>8}{:>11}  {}"
LEFT_OUT = ("duplicate_stamp", "equal_stamps", "no_stamp", "late_stamp", "stray_stamp", "not_finite")
HEAD = ROW.format("folder", "file", "samples", "strides", "ATE2 m", "ATE3 m", "closure m", "notices")


@dataclasses.dataclass(frozen=True)
class Run:
    """One sensor of one recording, as `pdr run` leaves it."""

    folder: str
    name: str
    result: Result
    track: Trajectory

    def __str__(self) -> str:
        r, truth = self.result, self.result.truth
        ate2, ate3 = (f"{truth.ate2_m:.3f}", f"{truth.ate3_m:.3f}") if truth else ("-", "-")
        true_strides = f"/{truth.stride_count_true}" if truth and truth.stride_count_true else ""
        notices = ", ".join(f"{n.kind} x{n.count}" for n in r.notices)
        strides, closure = f"{r.strides}{true_strides}", f"{r.closure_2d_m:.3f}"
        return ROW.format(self.folder, self.name, r.samples, strides, ate2, ate3, closure, notices)


def run(path: Path, out: Path, smooth: bool = False) -> list[Run]:
    """Run every sensor of a recording, and read the trajectory back from the file that users get."""
    result = each_estimated(open_recording(path), Params(), RunOptions(out, smooth=smooth))
    sensors = result.sensors if isinstance(result, SensorsResult) else {"": result}
    return [
        Run(path.parent.name, f"{path.stem} {s}", r, read_tum(out / s / "trajectory.tum")) for s, r in sensors.items()
    ]


@pytest.fixture(scope="module")
def runs(recordings: Path, tmp_path_factory: pytest.TempPathFactory) -> list[Run]:
    out = tmp_path_factory.mktemp("runs")
    paths = [path for folder, (pattern, _) in FOLDERS.items() for path in sorted((recordings / folder).glob(pattern))]
    done = [one for path in paths for one in run(path, out / path.stem)]
    print("", HEAD, *done, sep="\n")
    return done


def of(runs: list[Run], folder: str) -> list[Run]:
    return [one for one in runs if one.folder == folder]


def test_every_recording_gives_a_whole_and_finite_track(runs: list[Run]) -> None:
    assert {folder: len({one.name.split()[0] for one in of(runs, folder)}) for folder in FOLDERS} == {
        folder: count for folder, (_, count) in FOLDERS.items()
    }
    for one in runs:
        left_out = sum(n.count for n in one.result.notices if n.kind in LEFT_OUT)
        assert length(one.track) == one.result.samples - left_out, one.name
        assert (np.diff(one.track.stamp_ns) > 0).all(), one.name
        assert np.isfinite(one.track.position_m).all(), one.name
        assert np.linalg.norm(one.track.quat_xyzw, axis=1) == pytest.approx(1.0, abs=1e-6), one.name


def test_every_gait_in_the_motion_capture_room(runs: list[Run]) -> None:
    ate2_m = {one.name: one.result.truth.ate2_m for one in of(runs, "pyshoe_vicon")}
    assert len(ate2_m) == 28
    assert np.mean(list(ate2_m.values())) <= 0.070
    assert np.median(list(ate2_m.values())) <= 0.050
    assert {name: error for name, error in ate2_m.items() if not error <= 0.25} == {}


def test_every_gait_in_the_motion_capture_room_smoothed(
    recordings: Path, runs: list[Run], tmp_path_factory: pytest.TempPathFactory
) -> None:
    out = tmp_path_factory.mktemp("smoothed")
    paths = sorted((recordings / "pyshoe_vicon").glob("*.mat"))
    smoothed = [one for path in paths for one in run(path, out / path.stem, smooth=True)]
    print("", HEAD, *smoothed, sep="\n")
    ate2_m, before_m = ([one.result.truth.ate2_m for one in some] for some in (smoothed, of(runs, "pyshoe_vicon")))
    assert [one.result.strides for one in smoothed] == [one.result.strides for one in of(runs, "pyshoe_vicon")]
    assert len(ate2_m) == 28
    assert np.mean(ate2_m) <= 0.060
    assert np.median(ate2_m) <= 0.045
    assert np.mean(ate2_m) < 0.95 * np.mean(before_m)
    assert max(np.subtract(ate2_m, before_m)) < 0.01


def test_a_loop_closes(runs: list[Run]) -> None:
    (walk,) = of(runs, "xio_ngimu")
    assert walk.result.closure_2d_m <= 0.04
    assert 20.0 < walk.result.distance_m < 30.0


def test_strides_are_counted_and_as_long_as_they_are(recordings: Path, runs: list[Run]) -> None:
    tiles = of(runs, "tile_walks_marg")
    counts = [one.result.strides for one in tiles]
    assert counts == [one.result.truth.stride_count_true for one in tiles]
    assert np.mean([one.result.truth.ate2_m for one in tiles]) <= 0.30
    for one in tiles:
        session = open_recording(recordings / "tile_walks_marg" / f"{one.name.split()[0]}.csv")
        true_m = path_length_m(session.sensors["imu"].truth.position_m)
        assert one.result.distance_m == pytest.approx(true_m, rel=0.015), one.name


@pytest.mark.parametrize(("folder", "count"), [("ros1_foot_imu", 1), ("xio_ximu_marg", 2), ("gaitmap_dual_foot", 2)])
def test_walks_without_a_claim_on_their_error(runs: list[Run], folder: str, count: int) -> None:
    assert len(of(runs, folder)) == count
    for one in of(runs, folder):
        farthest_m = np.abs(one.track.position_m).max()
        assert one.result.strides >= 5, one.name
        assert np.isfinite(one.result.end_position_m).all(), one.name
        assert farthest_m < 200.0, one.name


def test_a_broken_copy_gives_what_can_be_read(recordings: Path, runs: list[Run], tmp_path: Path) -> None:
    (whole,) = of(runs, "xio_ngimu")
    source = recordings / "xio_ngimu" / "short_walk.csv"
    broken = tmp_path / source.name
    broken.write_bytes(source.read_bytes()[: source.stat().st_size * 6 // 10])  # ends within a row
    (part,) = run(broken, tmp_path / "out")
    assert 0.55 < part.result.samples / whole.result.samples < 0.65
    assert 0 < part.result.strides < whole.result.strides
    settled = length(part.track) - 500  # the last verdicts wait for samples that the copy has lost
    assert np.array_equal(part.track.position_m[:settled], whole.track.position_m[:settled])
