"""A simulated walk as a session."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from pdr_core.conventions import NANOSECONDS
from pdr_core.params import Params, changed
from pdr_core.recording import Sensor, Session
from pdr_core.records import ImuBlock, length, part
from pdr_core.simulation import simulated_walk

NO_FILE = Path(os.devnull)
START_NS = NANOSECONDS  # to ROS a stamp of zero is none


def simulated_session(params: Params, wanted: Mapping[str, Any]) -> Session:
    """Return the walk that the parameters, some of them changed, describe; ParameterError if one is not allowed."""
    chosen = changed(params, "simulation", **wanted)
    walk = simulated_walk(chosen.simulation, chosen.place, START_NS)

    def pieces(max_samples: int) -> Iterator[ImuBlock]:
        for start in range(0, length(walk.imu), max_samples):
            yield part(walk.imu, start, start + max_samples)

    return Session("simulated", NO_FILE, "simulated", {"imu": Sensor("imu", walk.truth, pieces)})
