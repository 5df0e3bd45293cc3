"""Times gaitmap's RtsKalman with its default detector on the walks of an .npz file; runs in its own environment.

Usage: gaitmap_speed.py WALKS.npz ROUNDS. Walk i is `gyro_radps_i`, `accel_mps2_i`, `rate_hz_i` and, at its start,
`quat_xyzw_i`.
"""

import json
import sys
import time

import numpy as np
import pandas as pd
from gaitmap.trajectory_reconstruction import RtsKalman
from gaitmap.utils.consts import SF_COLS


def estimated(walks: list[tuple[pd.DataFrame, np.ndarray, float]]) -> float:
    """Estimate all walks and return the processor time [s]; what makes the data frames is not in it."""
    begin = time.process_time()
    for data, quat_xyzw, rate_hz in walks:
        trajectory = RtsKalman(initial_orientation=quat_xyzw).estimate(data, sampling_rate_hz=rate_hz)
        assert len(trajectory.position_) == len(data) + 1
    return time.process_time() - begin


file = np.load(sys.argv[1])
walks = []
for i in range(sum(name.startswith("rate_hz_") for name in file)):
    columns = np.column_stack([file[f"accel_mps2_{i}"], np.degrees(file[f"gyro_radps_{i}"])])
    walks.append((pd.DataFrame(columns, columns=SF_COLS), file[f"quat_xyzw_{i}"], float(file[f"rate_hz_{i}"])))
first_s = estimated(walks)
best_s = min(estimated(walks) for _ in range(int(sys.argv[2])))
samples = sum(len(data) for data, _, _ in walks)
print(json.dumps({"samples_per_s": samples / best_s, "compile_s": first_s - best_s}))
