import numpy as np
import pytest

from pdr_core.recording.strides import write_strides
from pdr_core.records import StepEvent
from pdr_core.records_gait import Stride

OLD = "stride,t_s,x_m,y_m,z_m,length_m,heading_rad"
NEW = "start_s,dx_m,dy_m,dz_m,duration_s,cadence_per_min,speed_mps,stance_s,swing_s,clearance_m,turn_rad"
NEW += ",heading_change_rad,toe_off_s,heel_strike_s,pitch_max_rad,pitch_min_rad"
UNKNOWN = (None,) * 11


def stride(index, position_m, displacement_m, figures=UNKNOWN):
    start_ns = 1_700_000_000_000_000_001 + index * 10**9
    position, displacement = np.array(position_m), np.array(displacement_m)
    return Stride(StepEvent(index, start_ns, start_ns + 10**9, position, displacement, np.eye(3), 0.0, 0.1), *figures)


def written(tmp_path, strides):
    write_strides(tmp_path / "strides.csv", strides)
    return (tmp_path / "strides.csv").read_text().splitlines()


def test_the_start_comes_first_and_then_every_step(tmp_path):
    strides = [stride(1, [1.0, 2.0, 0.5], [0.6, 0.8, 0.1]), stride(2, [1.0, 1.0, 0.5], [0.0, -1.0, 0.0])]
    lines = written(tmp_path, strides)
    assert lines[0] == f"{OLD},{NEW}"
    assert lines[1].startswith("0,1700000001.000000001,0.400000,1.200000,0.400000,0.000000,0.000000,,")
    assert lines[2].startswith("1,1700000002.000000001,1.000000,2.000000,0.500000,1.000000,")
    assert float(lines[2].split(",")[6]) == pytest.approx(np.arctan2(0.8, 0.6), abs=1e-6)
    assert lines[3].startswith("2,1700000003.000000001,1.000000,1.000000,0.500000,1.000000,-1.570796,1700000002.000")
    assert len(lines) == 4


def test_every_figure_has_its_column_and_what_is_unknown_is_empty(tmp_path):
    toe_off_ns, strike_ns = 1_700_000_001_250_000_000, 1_700_000_001_700_000_000
    figures = (1.2, 0.7, 0.5, 0.12, 0.1, -0.2, toe_off_ns, strike_ns, 0.9, -0.3, np.zeros(101))
    lines = written(tmp_path, [stride(1, [1.0, 0.0, 0.3], [1.2, 0.0, 0.3], figures), stride(2, [1.0] * 3, [0.0] * 3)])
    row = dict(zip(lines[0].split(","), lines[2].split(","), strict=True))
    assert (row["start_s"], row["dx_m"], row["dz_m"]) == ("1700000001.000000001", "1.200000", "0.300000")
    assert (row["duration_s"], row["cadence_per_min"], row["speed_mps"]) == ("1.200000", "100.000000", "1.000000")
    assert (row["stance_s"], row["swing_s"], row["clearance_m"]) == ("0.700000", "0.500000", "0.120000")
    assert (row["turn_rad"], row["heading_change_rad"]) == ("0.100000", "-0.200000")
    assert (row["toe_off_s"], row["heel_strike_s"]) == ("1700000001.250000000", "1700000001.700000000")
    assert (row["pitch_max_rad"], row["pitch_min_rad"]) == ("0.900000", "-0.300000")
    assert lines[1].split(",")[7:] == [""] * 16
    assert lines[3].split(",")[11:] == [""] * 12
    assert "nan" not in "".join(lines)


def test_a_walk_without_steps_leaves_the_header(tmp_path):
    assert len(written(tmp_path, [])) == 1
