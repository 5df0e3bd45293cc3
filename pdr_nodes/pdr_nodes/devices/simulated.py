"""A simulated sensor on a simulated foot."""

from pdr_core.params import Params
from pdr_core.simulation import simulated_walk
from pdr_nodes.devices.source import Source


def simulated(params: Params, start_ns: int) -> Source:
    """Return the walk that the parameters describe, beginning at a stamp."""
    walk = simulated_walk(params.simulation, params.place, start_ns)
    return Source(f"simulated {params.simulation.walk} walk", iter([walk.imu]), walk.truth)
