"""When the gyro is on, and what that costs."""

from pdr_core.power.driver_watch import DriverWatch
from pdr_core.power.energy import EnergyModel
from pdr_core.power.gyro_switch import GyroSwitch
from pdr_core.power.mode_manager import ModeManager
from pdr_core.power.supervision import Supervision
from pdr_core.power.timeline import PowerTimeline

__all__ = ["DriverWatch", "EnergyModel", "GyroSwitch", "ModeManager", "PowerTimeline", "Supervision"]
