"""Trajectories in the TUM format, `t x y z qx qy qz qw`: seconds, metres, unit quaternion (world from foot)."""

from pathlib import Path
from typing import NamedTuple, TextIO

import numpy as np

from pdr_core.maths.quaternion import multiply
from pdr_core.recording.session import RecordingError
from pdr_core.recording.stamps import stamp_ns_from_text, text_from_stamp_ns
from pdr_core.records import Floats, Stamps
from pdr_core.records_external import ExternalFrame

HEADER = "# timestamp[s] x[m] y[m] z[m] qx qy qz qw\n"
POSE = " %.10f" * 7 + "\n"


class Trajectory(NamedTuple):
    """n poses of one foot in the world frame."""

    stamp_ns: Stamps  # (n,)
    position_m: Floats  # (n, 3)
    quat_xyzw: Floats  # (n, 4)


def write_tum_header(file: TextIO) -> None:
    """Write the comment line that a TUM file starts with."""
    file.write(HEADER)


def append_tum(file: TextIO, trajectory: Trajectory) -> None:
    """Append poses to an open file, exact to the nanosecond and to 1e-10 m."""
    poses = np.column_stack([trajectory.position_m, trajectory.quat_xyzw]).tolist()
    rows = zip(trajectory.stamp_ns.tolist(), poses, strict=True)
    file.writelines(text_from_stamp_ns(stamp_ns) + POSE % tuple(pose) for stamp_ns, pose in rows)


def read_tum(path: Path) -> Trajectory:
    """Read a TUM file; RecordingError if it is missing or a row does not hold eight numbers."""
    dtype = np.dtype([("stamp_ns", np.int64), ("pose", np.float64, (7,))])
    if not path.exists():
        raise RecordingError(f"{path} does not exist: check the path.")
    try:
        lines = [line for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
        table = _loaded(lines, dtype) if lines else np.empty(0, dtype)
    except (OSError, ValueError) as error:
        raise RecordingError(f"{path} is not a TUM trajectory of `t x y z qx qy qz qw` rows: {error}") from error
    return Trajectory(table["stamp_ns"], table["pose"][:, :3], table["pose"][:, 3:])


def in_frame(trajectory: Trajectory, frame: ExternalFrame) -> Trajectory:
    """Return a trajectory of ours in somebody else's frame, by our stamps."""
    quats = [multiply(frame.quat_xyzw, quat) for quat in trajectory.quat_xyzw]
    return Trajectory(trajectory.stamp_ns, frame.theirs_m(trajectory.position_m), np.array(quats).reshape(-1, 4))


def _loaded(lines: list[str], dtype: np.dtype) -> np.ndarray:
    return np.loadtxt(lines, dtype, comments=None, ndmin=1, converters={0: stamp_ns_from_text}, encoding="utf-8")
