"""Judged samples in; estimates, steps and what the mode manager is told out: the same object in `gait_dr` and offline.

Samples are taken in pieces that end at multiples of `PIECE_NS`, in whatever blocks they come. What happens between two
pieces, as forgetting a model that has failed, therefore happens at a stamp, and gives the same track once more there.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.params import Params
from pdr_core.pipeline.adaptive_navigation import AdaptiveNavigation, Navigated
from pdr_core.pipeline.foot_inertial import FootOutput, together
from pdr_core.pipeline.gait_watch import GaitWatch
from pdr_core.pipeline.swing_samples import Bridged, SwingSamples
from pdr_core.records import NO_VERDICTS, FilterHealth, Notice, PoseEstimate, Stamps, StanceBlock, joined, length, part
from pdr_core.records_power import Sensed, Walk

PIECE_NS = 50_000_000


class Moved(NamedTuple):
    """What became known with a piece."""

    output: FootOutput
    walk: Walk
    sensed: Sensed


class AdaptiveFoot:
    """Navigates with the gyro and without it, and sees what decides between both."""

    def __init__(self, params: Params) -> None:
        self._watch = GaitWatch(params)
        self._navigation = AdaptiveNavigation(params)
        self._swings = SwingSamples(params) if params.power.duty == "swing" else None
        self._waiting = NO_VERDICTS  # samples of a piece that has not ended
        self._rest_tested = False
        self._last_ns = NO_STAMP

    def run(self, judged: StanceBlock) -> Iterator[Moved]:
        """Yield what the next samples make known; what is told between two pieces holds from the next one on."""
        self._waiting = joined([self._waiting, judged])
        while end := piece_end(self._waiting.imu.stamp_ns):
            piece, self._waiting = part(self._waiting, 0, end), part(self._waiting, end)
            yield self._moved(piece)

    def finish(self) -> FootOutput:
        """Return what the end of the samples makes certain; more may come all the same."""
        last, self._waiting = self._waiting, NO_VERDICTS
        output = [self._moved(last).output] if length(last) else []
        if self._swings:
            output += self._bridged(self._swings.finish()).outputs
        return together([*output, *self._navigation.finish().outputs])

    def forget_length(self) -> None:
        """Learn the length of strides like the last one anew: the model has failed."""
        self._navigation.forget_length()

    def place(self, pose: PoseEstimate, keep_biases: bool) -> None:
        """Go on from a pose at which somebody says the foot stands."""
        self._navigation.place(pose, keep_biases)

    @property
    def health(self) -> FilterHealth:
        """How far the estimate can be trusted now."""
        return self._navigation.health

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._navigation.notices

    def _moved(self, piece: StanceBlock) -> Moved:
        known = self._navigated(piece)
        rested = bool((piece.rest_sd_radps > 0.0).any())
        self._rest_tested = self._rest_tested or rested or bool(known.measured)  # no rest came before the walk
        sensed = self._sensed(piece)
        self._last_ns = int(piece.imu.stamp_ns[-1])
        return Moved(together(known.outputs), self._walk(known), sensed)

    def _navigated(self, piece: StanceBlock) -> Navigated:
        if self._swings is None:
            return self._navigation.run(piece, self._watch.run(piece.imu))
        return self._bridged(self._swings.run(piece.imu, self._navigation.gyro_bias_radps))

    def _bridged(self, samples: Bridged) -> Navigated:
        if samples.slept:
            self._navigation.doubt_heading()
        return self._navigation.run(samples.judged, self._watch.run(samples.imu), samples.share_about_up)

    def _walk(self, known: Navigated) -> Walk:
        """Return what the manager is told."""
        return Walk(
            self._last_ns,
            self._watch.behaviour,
            self._rest_tested,
            self._navigation.ready and (self._swings is None or self._swings.ready),
            self._navigation.turning,
            tuple(known.measured),
            known.reckoned,
        )

    def _sensed(self, piece: StanceBlock) -> Sensed:
        """Return what the samples tell of the driver."""
        imu = piece.imu
        passed_ns = int(imu.stamp_ns[-1]) - self._last_ns if self._last_ns != NO_STAMP else 0
        rate_hz = length(imu) * NANOSECONDS / passed_ns if passed_ns > 0 else 0.0
        return Sensed(bool((imu.gyro_sd_radps >= 0.0).any()), bool((imu.field_sd_tesla >= 0.0).any()), rate_hz)


def piece_end(stamp_ns: Stamps) -> int:
    """Return how many samples are before the first multiple of `PIECE_NS` that was passed; 0: none was."""
    passed = np.flatnonzero(np.diff(stamp_ns // PIECE_NS))
    return int(passed[0]) + 1 if len(passed) else 0
