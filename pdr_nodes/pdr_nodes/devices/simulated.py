"""A simulated sensor on a simulated foot, alone or one of two."""

from pdr_core.params import Params
from pdr_core.simulation import SimulatedWalk, simulated_feet, simulated_walk
from pdr_nodes.devices.source import Source


def simulated(params: Params, start_ns: int) -> Source:
    """Return the walk that the parameters describe, beginning at their stamp, or at `start_ns` if they name none."""
    foot, walk = params.simulation.foot, walked(params, params.simulation.start_ns or start_ns)
    whose = "" if foot == "single" else f", {foot} foot"
    return Source(f"simulated {params.simulation.walk} walk{whose}", iter([walk.imu]), walk.truth)


def walked(params: Params, start_ns: int) -> SimulatedWalk:
    """Return the walk of the foot that the parameters name."""
    if params.simulation.foot == "single":
        return simulated_walk(params.simulation, params.place, start_ns)
    return simulated_feet(params.simulation, params.place, start_ns)[params.simulation.foot]
