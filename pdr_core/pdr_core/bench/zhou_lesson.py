"""The first lap of the octagon, which teaches: by the filter on the way, and offline by its true lengths."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pdr_core.bench.zhou_walks import Octagon, pieces, told
from pdr_core.gait.stands import Stand
from pdr_core.gait.step_length.frequency_linear import FREQUENCY_LINEAR
from pdr_core.gait.step_length_calibration import Group, calibrated_offline
from pdr_core.gait.stride_pairing import paired
from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.pipeline.gait_model import GaitModel
from pdr_core.pipeline.gait_watch import GaitWatch, SeenStride
from pdr_core.pipeline.recent_track import yaw_of
from pdr_core.records import Handover, ImuBlock, NavBlock, PoseEstimate, StepEvent, joined

FILTER_HZ = 200  # of the first lap
PIECE_S = 0.25


@dataclass(frozen=True)
class Lesson:
    """What the first lap leaves behind."""

    octagon: Octagon
    params: Params
    samples: list[ImuBlock]  # of it
    watch: GaitWatch
    model: GaitModel
    offline: Group
    start: Handover
    nav: NavBlock
    steps: list[StepEvent]


def lesson(octagon: Octagon) -> Lesson:
    """Walk the first lap with the filter, and learn."""
    params, samples = told(), pieces(octagon.lap(1, FILTER_HZ), PIECE_S, FILTER_HZ)
    nav, steps = navigated(params, samples)
    watch, model = GaitWatch(params), GaitModel(params)
    strides = [stride for piece in samples for stride in watch.run(piece).strides]
    stood = learn(model, strides, nav, steps)
    return Lesson(octagon, params, samples, watch, model, offline(octagon, strides, params), stood, nav, steps)


def navigated(params: Params, samples: Sequence[ImuBlock]) -> tuple[NavBlock, list[StepEvent]]:
    """Return the estimates of the filter and its steps."""
    chain = FootInertial(params)
    outputs = [*map(chain.run, samples), chain.finish()]
    return joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps]


def learn(model: GaitModel, strides: Sequence[SeenStride], nav: NavBlock, steps: Sequence[StepEvent]) -> Handover:
    """Let a model learn from the strides that the filter has measured; return the pose at the last stand."""
    measured = {stride.index: step for stride, step in paired([s.step for s in strides], steps)}
    last = None
    for stride in strides:
        before, after = pose(nav, stride.before), pose(nav, stride.stand)
        if before and after and stride.step.index in measured:
            model.learn(stride, measured[stride.step.index], yaw_of(before), yaw_of(after), north=True)
        if stride.stand and after:
            last = Handover(stride.stand.stamp_ns, after, None)
    assert last
    return last


def pose(nav: NavBlock, stand: Stand | None) -> PoseEstimate | None:
    """Return the filter's pose at a stand; None of none."""
    if stand is None:
        return None
    i = row_of(nav, stand.stamp_ns)
    return PoseEstimate(nav.position_m[i], nav.quat_xyzw[i], nav.pose_covariance[i])


def row_of(nav: NavBlock, stamp_ns: int) -> int:
    """Return the row of the estimate at a stamp, or the last one."""
    return min(int(np.searchsorted(nav.stamp_ns, stamp_ns)), len(nav.stamp_ns) - 1)


def offline(octagon: Octagon, strides: Sequence[SeenStride], params: Params) -> Group:
    """Return the line over the frequency through the true lengths of the strides."""
    ends = [int(np.argmin(np.abs(octagon.stand_ns - stride.step.stamp_ns))) for stride in strides]
    lengths_m = [float(np.linalg.norm(octagon.stand_m[i] - octagon.stand_m[i - 1])) for i in ends]
    return calibrated_offline(FREQUENCY_LINEAR, [stride.step for stride in strides], lengths_m, params.gait)
