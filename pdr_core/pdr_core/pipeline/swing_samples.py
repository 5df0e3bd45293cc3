"""Samples of a gyro that sleeps while the foot stands, as the filter and the watch of the gait want them.

With its rates filled in, a sample is judged anew. What a filled rate does not tell is not asked of it: neither the
gyro bias, by a rest or by the field that a standing foot sees turn, nor more of the heading than its noise says.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.params import Params
from pdr_core.pipeline.swing_bridge import SwingBridge
from pdr_core.power.motion_rule import motion_rule
from pdr_core.records import Floats, ImuBlock, Stamps, StanceBlock, joined
from pdr_core.stance import StanceDetection


class Bridged(NamedTuple):
    """The same samples twice."""

    judged: StanceBlock  # for the filter
    imu: ImuBlock  # for the watch of the gait, which asks for the field and not for the gyro
    slept: bool  # the gyro has, by now
    share_about_up: Floats  # (n,) of the noise of their rates


class SwingSamples:
    """Judged samples in, with and without rates; the same with rates out, as far as they are known."""

    def __init__(self, params: Params) -> None:
        self._bridge = SwingBridge(motion_rule(params.power))
        self._stance = StanceDetection(params.stance, params.place, params.detectors)
        self._filled_ns: Stamps = np.zeros(0, np.int64)  # samples that wait for their verdict
        self._slept = False

    @property
    def ready(self) -> bool:
        """Enough was learnt to let the gyro sleep."""
        return self._bridge.ready

    def run(self, imu: ImuBlock, bias_radps: Floats) -> Bridged:
        """Return the samples that are known now; `bias_radps` (3,) of the gyro."""
        self._bridge.bias_radps = bias_radps
        self._filled_ns = np.concatenate([self._filled_ns, imu.stamp_ns[imu.gyro_sd_radps < 0.0]])
        return self._hidden(self._stance.run(self._bridge.run(imu)))

    def finish(self) -> Bridged:
        """Return the rest: there will be no later samples."""
        return self._hidden(joined([self._stance.run(self._bridge.finish()), self._stance.finish()]))

    def _hidden(self, judged: StanceBlock) -> Bridged:
        filled = np.isin(judged.imu.stamp_ns, self._filled_ns)
        self._slept = self._slept or bool(filled.any())
        self._filled_ns = self._filled_ns[~np.isin(self._filled_ns, judged.imu.stamp_ns)]
        blind = judged.imu._replace(field_sd_tesla=np.where(filled, -1.0, judged.imu.field_sd_tesla))
        known_sd = np.zeros_like(judged.rest_sd_radps) if self._slept else judged.rest_sd_radps
        share = np.where(filled, self._bridge.share_about_up, 1.0)
        return Bridged(judged._replace(imu=blind, rest_sd_radps=known_sd), judged.imu, self._slept, share)
