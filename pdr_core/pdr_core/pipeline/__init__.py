"""Where stages meet: the same chain that the nodes form live."""

from pdr_core.pipeline.foot_inertial import FootInertial, FootOutput
from pdr_core.pipeline.oriented import OrientedIntake
from pdr_core.pipeline.smoothed import SmoothedFoot
from pdr_core.pipeline.stance_phases import stance_phases

__all__ = ["FootInertial", "FootOutput", "OrientedIntake", "SmoothedFoot", "stance_phases"]
