"""Keeps of a track what every result and every folder of a run has: its score, its duration and its file."""

from contextlib import ExitStack
from pathlib import Path
from typing import TextIO

import numpy as np

from pdr_bringup_scripts.problems import Problem
from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.score import Scorer
from pdr_core.recording.tum import Trajectory, append_tum, write_tum_header
from pdr_core.records import NavBlock, Truth, length


def make_folder(path: Path) -> None:
    """Create a folder, or say why that cannot be done."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except FileExistsError as error:
        raise Problem(f"cannot write to {path}: it is a file, and a folder is needed") from error
    except OSError as error:
        raise Problem(f"cannot write to {path}: {error.strerror}") from error


class TrackBook:
    """Takes every estimate once; `out` is the folder of the file, None: there is none."""

    def __init__(self, truth: Truth | None, out: Path | None, stack: ExitStack) -> None:
        self.scorer = Scorer(truth)
        self.rows = 0
        self.duration_s = 0.0  # of the estimate; where the clock jumps back, nobody knows how much time passed
        self._last_ns: int | None = None
        self._file: TextIO | None = None
        if out:
            make_folder(out)
            self._file = stack.enter_context((out / "trajectory.tum").open("w"))
            write_tum_header(self._file)

    def keep(self, nav: NavBlock) -> None:
        """Take the next estimates."""
        if not length(nav):
            return
        steps_ns = np.diff(nav.stamp_ns, prepend=nav.stamp_ns[0] if self._last_ns is None else self._last_ns)
        self.duration_s += float(np.clip(steps_ns, 0, None).sum()) / NANOSECONDS
        self._last_ns = int(nav.stamp_ns[-1])
        self.rows += length(nav)
        self.scorer.add(nav)
        if self._file:
            append_tum(self._file, Trajectory(nav.stamp_ns, nav.position_m, nav.quat_xyzw))
