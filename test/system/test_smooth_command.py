"""`pdr run --smooth`, as it is typed."""

import json

import numpy as np
import pytest

from pdr_core.recording.tum import read_tum
from support.processes import check_refused, pdr
from support.walks import straight_walk, write_csv


def run(*arguments):
    answer = pdr("run", *arguments)
    assert answer.returncode == 0, answer.stderr
    return answer


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A walk in the middle of which 3 s are missing, as the filter and as the smoother has it."""
    folder = tmp_path_factory.mktemp("smoothed")
    imu = straight_walk(6).imu
    imu.stamp_ns[700:] += 3_000_000_000
    walk = write_csv(folder / "walk.csv", imu)
    run(walk, "--out", folder / "filtered")
    run(walk, "--out", folder / "smoothed", "--smooth")
    return folder


def test_it_writes_the_same_files_with_another_track(folder):
    names = [sorted(path.name for path in (folder / kind).iterdir()) for kind in ("filtered", "smoothed")]
    assert names[0] == names[1]
    before, after = (read_tum(folder / kind / "trajectory.tum") for kind in ("filtered", "smoothed"))
    np.testing.assert_array_equal(before.stamp_ns, after.stamp_ns)
    difference_m = np.linalg.norm(before.position_m - after.position_m, axis=1)
    assert 1e-4 < difference_m.max() < 1.0
    assert difference_m[-1] < 1e-6


def test_the_result_says_so(folder):
    before, after = (json.loads((folder / kind / "result.json").read_text()) for kind in ("filtered", "smoothed"))
    assert before["pipeline"] == after["pipeline"] == "foot_inertial"
    assert (before["smoothed"], after["smoothed"]) == (False, True)
    assert after["strides"] == before["strides"] > 0
    assert after["samples"] == before["samples"]
    assert after["notices"] == before["notices"]
    assert "foot_inertial, smoothed" in (folder / "smoothed" / "report.html").read_text()


def test_a_person_is_told(folder):
    assert "smoothed" in run(folder / "walk.csv", "--smooth").stdout
    assert "smoothed" not in run(folder / "walk.csv").stdout


def test_a_recording_without_a_usable_sample_is_one_sentence(tmp_path):
    imu = straight_walk(1).imu
    imu.accel_mps2[:] = np.nan
    check_refused(pdr("run", write_csv(tmp_path / "nan.csv", imu), "--smooth"), "holds no usable sample")
