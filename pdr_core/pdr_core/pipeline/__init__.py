"""Where stages meet: the same chain that the nodes form live."""

from pdr_core.pipeline.adaptive_foot import AdaptiveFoot
from pdr_core.pipeline.aided_feet import AidedFeet
from pdr_core.pipeline.aided_foot import AidedFoot
from pdr_core.pipeline.aided_fusion import AidedFusion
from pdr_core.pipeline.body_steps import BodySteps
from pdr_core.pipeline.both_feet import BothFeet, BothOutput
from pdr_core.pipeline.chest import ChestCard
from pdr_core.pipeline.compared_feet import ComparedFeet
from pdr_core.pipeline.compared_foot import ComparedFoot
from pdr_core.pipeline.constrained_foot import ConstrainedFoot
from pdr_core.pipeline.foot_adaptive import FootAdaptive
from pdr_core.pipeline.foot_gait import FootGait
from pdr_core.pipeline.foot_inertial import FootInertial, FootOutput
from pdr_core.pipeline.heading_fusion import FusionOutput, HeadingFusion
from pdr_core.pipeline.oriented import OrientedIntake
from pdr_core.pipeline.placed_body import PlacedBody
from pdr_core.pipeline.smoothed import SmoothedFoot
from pdr_core.pipeline.stance_phases import stance_phases

__all__ = [
    "AdaptiveFoot",
    "AidedFeet",
    "AidedFoot",
    "AidedFusion",
    "BodySteps",
    "BothFeet",
    "BothOutput",
    "ChestCard",
    "ComparedFeet",
    "ComparedFoot",
    "ConstrainedFoot",
    "FootAdaptive",
    "FootGait",
    "FootInertial",
    "FootOutput",
    "FusionOutput",
    "HeadingFusion",
    "OrientedIntake",
    "PlacedBody",
    "SmoothedFoot",
    "stance_phases",
]
