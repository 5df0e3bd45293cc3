"""Where samples come from: one file per device, one form for all."""

from pdr_core.params import DriverParams
from pdr_nodes.devices.replayed import replayed
from pdr_nodes.devices.simulated import simulated
from pdr_nodes.devices.source import Source

__all__ = ["Source", "open_device"]


def open_device(params: DriverParams, start_ns: int) -> Source:
    """Open the device that the parameters name; a simulated one begins at `start_ns`."""
    return simulated(params, start_ns) if params.device == "simulated" else replayed(params)
