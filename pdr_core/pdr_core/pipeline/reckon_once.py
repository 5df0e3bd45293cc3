"""One stride learnt, told and reckoned, so that all that it needs is compiled: two samples reach none.

It ends in a stand that nobody has seen, as a runner's does; no other walk for the cache has one.
"""

from dataclasses import replace

import numpy as np

from pdr_core.gait.dead_reckoning import GaitDeadReckoning
from pdr_core.gait.unseen_stands import UnseenStands
from pdr_core.params import Params
from pdr_core.pipeline.gait_model import GaitModel
from pdr_core.pipeline.gait_watch import SeenStride
from pdr_core.records import StepEvent
from pdr_core.records_gait import Angle, Behaviour, FieldHeading, GaitStep

STEP = GaitStep(1, 0, 1_000_000_000, Behaviour.RUNNING, 1.0, 1.0, 9.0, -3.0, 2.0)
UP_MPS2, FIELD_TESLA = (0.0, 0.0, 9.81), (0.0, 2e-5, -4e-5)


def reckon_once(params: Params) -> None:
    """Reckon a stride straight ahead."""
    ahead_m = np.array([1.5, 0.0, 0.0])
    measured = StepEvent(1, STEP.start_ns, STEP.stamp_ns, ahead_m, ahead_m, 1e-4 * np.eye(3), 0.0, 0.1)
    stand = UnseenStands(params.gait).stand(STEP, np.array(UP_MPS2))
    stand = replace(stand, field_tesla=np.array(FIELD_TESLA), field_seen=True, impulse_mps=np.zeros(2))
    stride, model, track = SeenStride(STEP, None, stand), GaitModel(params), GaitDeadReckoning(params.dead_reckoning)
    model.learn(stride, measured, Angle(0.0, 0.1), Angle(0.0, 0.1), north=True)
    told = model.told(stride)
    track.step(STEP, told.length, told.turn, told.deviation, FieldHeading(0.0, 0.1, 0.1))
    track.take_heading(0.1, 0.1)
    track.stand(STEP.stamp_ns + 1)
