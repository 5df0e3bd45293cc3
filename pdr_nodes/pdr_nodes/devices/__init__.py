"""Where samples come from: one file per device, one form for all."""

from pdr_core.params import Params
from pdr_nodes.devices.replayed import replayed
from pdr_nodes.devices.simulated import simulated
from pdr_nodes.devices.source import Source

__all__ = ["Source", "open_device"]


def open_device(params: Params, start_ns: int) -> Source:
    """Open the device that the parameters name; a simulated one begins at `start_ns`."""
    return simulated(params, start_ns) if params.driver.device == "simulated" else replayed(params.driver)
