"""The orientation stage: samples in, orientations out (Qiu section 2.2)."""

import numpy as np

from pdr_core.attitude.orient import orient, orient_unjudged
from pdr_core.attitude.settings import settings
from pdr_core.attitude.state import AttitudeState, fresh_state
from pdr_core.params import Params
from pdr_core.records import AttitudeBlock, ImuBlock, Level, Notice, StanceBlock, length

KINDS = {
    "gaps": ("attitude_coasted", "intervals without rates: the orientation was held across them"),
    "doubted": ("attitude_doubted", "gravity contradicted the orientation until it gave way: it was off before"),
    "disturbed": ("field_disturbed", "the field is not that of the first rest: no heading was taken from it"),
}


class Orientation:
    """What both filters share: the memory, which can be saved and restored, and the notices."""

    def __init__(self, params: Params) -> None:
        self._settings = settings(params)
        self.state: AttitudeState = fresh_state()

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        start_ns = int(self.state.alignment_start_ns)
        counts = {name: int(self.state[name]) for name in KINDS}
        return [Notice(Level.WARN, *KINDS[name], count, start_ns) for name, count in counts.items() if count]


class QuaternionFilter(Orientation):
    """A Kalman filter of quaternion and gyro bias that a standing foot corrects by gravity, and by the field if told."""

    def run(self, block: StanceBlock) -> AttitudeBlock:
        """Return the orientation at each sample."""
        out = empty_attitude(length(block))
        orient(block, self._settings, self.state, out)
        return out


class UnjudgedQuaternionFilter(Orientation):
    """The same filter before any verdict: it weighs each sample by how much the foot moves."""

    def run(self, imu: ImuBlock) -> AttitudeBlock:
        """Return the orientation at each sample."""
        out = empty_attitude(length(imu))
        orient_unjudged(imu, self._settings, self.state, out)
        return out


def empty_attitude(count: int) -> AttitudeBlock:
    """Return room for `count` orientations."""
    return AttitudeBlock(np.empty(count, np.int64), np.empty((count, 4)), np.empty((count, 3, 3)), np.empty((count, 3)))
