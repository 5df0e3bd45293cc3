"""A simulated walk as a session."""

import os
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from pdr_core.conventions import NANOSECONDS
from pdr_core.params import Params, changed
from pdr_core.recording import Sensor, Session
from pdr_core.records import ImuBlock, length, part
from pdr_core.simulation import simulated_feet, simulated_walk
from pdr_core.simulation.external_source import ExternalSource, body_of, fixes, midway

NO_FILE = Path(os.devnull)
ROBOT = "/robot/pose"  # geometry_msgs/PoseWithCovarianceStamped
START_NS = NANOSECONDS  # to ROS a stamp of zero is none


def simulated_session(params: Params, wanted: Mapping[str, Any], feet: bool = False, external: bool = False) -> Session:
    """Return the walk that the parameters, some of them changed, describe; ParameterError if one is not allowed.

    Its sensor is "imu", or with `feet` there are two, "left" and "right". With `external` somebody else follows the
    body, on the topic `ROBOT`.
    """
    chosen = changed(params, "simulation", **wanted)
    if feet:
        walks = simulated_feet(chosen.simulation, chosen.place, START_NS)
    else:
        walks = {"imu": simulated_walk(chosen.simulation, chosen.place, START_NS)}
    sensors = {name: Sensor(name, walk.truth, partial(pieces, walk.imu)) for name, walk in walks.items()}
    truths = [walk.truth for walk in walks.values()]
    body = midway(*truths) if feet else body_of(*truths)
    beside = {ROBOT: fixes(body, ExternalSource(), chosen.simulation.seed)} if external else {}
    return Session("simulated", NO_FILE, "simulated", sensors, beside=beside)


def pieces(imu: ImuBlock, max_samples: int) -> Iterator[ImuBlock]:
    """Yield the samples, at most so many at a time."""
    for start in range(0, length(imu), max_samples):
        yield part(imu, start, start + max_samples)
