import numpy as np
import pytest

from pdr_core.recording.strides import write_strides
from pdr_core.records import StepEvent


def step(index, position_m, displacement_m):
    start_ns = 1_700_000_000_000_000_001 + index * 10**9
    position, displacement = np.array(position_m), np.array(displacement_m)
    return StepEvent(index, start_ns, start_ns + 10**9, position, displacement, np.eye(3), 0.0, 0.1)


def test_the_start_comes_first_and_then_every_step(tmp_path):
    steps = [step(1, [1.0, 2.0, 0.5], [0.6, 0.8, 0.1]), step(2, [1.0, 1.0, 0.5], [0.0, -1.0, 0.0])]
    write_strides(tmp_path / "strides.csv", steps)
    lines = (tmp_path / "strides.csv").read_text().splitlines()
    assert lines[0] == "stride,t_s,x_m,y_m,z_m,length_m,heading_rad"
    assert lines[1] == "0,1700000001.000000001,0.400000,1.200000,0.400000,0.000000,0.000000"
    assert lines[2].startswith("1,1700000002.000000001,1.000000,2.000000,0.500000,1.000000,")
    assert float(lines[2].split(",")[-1]) == pytest.approx(np.arctan2(0.8, 0.6), abs=1e-6)
    assert lines[3] == "2,1700000003.000000001,1.000000,1.000000,0.500000,1.000000,-1.570796"
    assert len(lines) == 4


def test_a_walk_without_steps_leaves_the_header(tmp_path):
    write_strides(tmp_path / "strides.csv", [])
    assert len((tmp_path / "strides.csv").read_text().splitlines()) == 1
