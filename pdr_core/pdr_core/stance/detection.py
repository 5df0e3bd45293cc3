"""The stance stage: samples in, samples with a verdict out, delayed by the half window that the statistic needs."""

from itertools import pairwise

import numpy as np

from pdr_core.conventions import NANOSECONDS, gravity_mps2, nanoseconds
from pdr_core.params import DetectorParams, PlaceParams, StanceParams
from pdr_core.records import NO_SAMPLES, Floats, ImuBlock, StanceBlock, joined, length, part
from pdr_core.stance import catalogue, relative_threshold, rest

DEFAULT_DETECTORS = DetectorParams()
NOT_SAID = 0.0  # how still the foot stands, without the gyro


class StanceDetection:
    """A detector of the family, the noise of its zero velocities, a time gate, and the soft rest test.

    How still a foot stands is told by the default's statistic, the GLRT, whichever detector judges that it stands.
    A verdict needs half a window of later samples and the one after them, which tells that the window is complete, and
    what the gate needs: it follows its sample by at most `latency_s` and one sample interval, with a gate two.
    `phases_s`, (n,), are the durations of all phases of the recording, where a first pass has told
    them to the gate that learns from them.
    """

    def __init__(
        self,
        params: StanceParams,
        place: PlaceParams,
        detectors: DetectorParams = DEFAULT_DETECTORS,
        phases_s: Floats | None = None,
    ) -> None:
        gravity = gravity_mps2(np.radians(place.latitude_deg), place.height_m)
        family = catalogue.detectors(params, detectors, gravity)
        self._stillness, self._detector = family["adaptive"], family[params.detector]
        self._half_window_ns = max(self._stillness.half_window_ns, self._detector.half_window_ns)
        self._fresh_gate = catalogue.time_gates(detectors, phases_s)[params.time_gate]
        self._threshold_limits = relative_threshold.ThresholdLimits(
            nanoseconds(params.memory_s),
            params.relative_share,
            params.threshold_min,
            params.threshold_max,
            params.quiet_max,
            params.still_sd_mps,
            params.sd_per_root_mps,
        )
        self._rest_limits = rest.RestLimits(
            params.rest_moving_radps,
            nanoseconds(params.rest_smoothing_s),
            nanoseconds(params.rest_guard_s),
            nanoseconds(params.rest_shortest_s),
            nanoseconds(params.rest_longest_s),
            nanoseconds(params.rest_later_s),
            params.rest_floor_radps,
            params.rest_turn_rad,
            params.rest_drift_radps2,
        )
        self._rest = rest.fresh_state()
        self._forget()

    @property
    def latency_s(self) -> float:
        """The longest time [s] from a sample to its verdict, but for one sample interval, with a gate two."""
        return self._half_window_ns / NANOSECONDS + (self._gate.latency_s if self._gate else 0.0)

    def run(self, imu: ImuBlock) -> StanceBlock:
        """Return the samples, of these and earlier ones, whose verdict is known now."""
        newest_ns = self._samples.stamp_ns[-1:] if length(self._samples) else imu.stamp_ns[:1]
        jumps_back = np.flatnonzero(np.diff(imu.stamp_ns, prepend=newest_ns[: length(imu)]) < 0)
        judged = []
        for start, stop in pairwise([0, *jumps_back, length(imu)]):
            if start in jumps_back:
                judged.append(self.finish())
                self._forget()
            judged.append(self._judge(part(imu, start, stop), final=False))
        return joined(judged)

    def finish(self) -> StanceBlock:
        """Return the samples that still wait for later ones, judged by what there is."""
        return self._judge(NO_SAMPLES, final=True)

    def _judge(self, imu: ImuBlock, final: bool) -> StanceBlock:
        samples, first = joined([self._samples, imu]), self._unjudged
        stop = self._complete(samples, final)
        stillness, statistic = self._statistics(samples, first, stop)
        out = part(samples, first, first + len(statistic))
        threshold, sd_mps = relative_threshold.thresholds(
            out.stamp_ns, stillness, self._threshold_limits, self._threshold
        )
        if self._detector.threshold is not None:
            threshold = np.full(len(statistic), self._detector.threshold)
            sd_mps[np.isinf(stillness)] = NOT_SAID
        rest_rate, rest_sd = rest.rests(out, self._rest_limits, self._rest)
        self._keep_what_later_windows_need(samples, first + len(statistic))
        judged = StanceBlock(out, statistic <= threshold, statistic, threshold, sd_mps, rest_rate, rest_sd)
        return self._gate.run(judged, final) if self._gate else judged

    def _complete(self, samples: ImuBlock, final: bool) -> int:
        """Return how many samples have a window that no later sample changes: the one after them belongs to it."""
        if final or not length(samples):
            return length(samples)
        within = np.searchsorted(samples.stamp_ns, samples.stamp_ns[-1] - self._half_window_ns, side="right")
        return min(int(within), length(samples) - 1)

    def _statistics(self, samples: ImuBlock, start: int, stop: int) -> tuple[Floats, Floats]:
        """Return the statistics of stillness and of the detector for the samples start:stop, once if they are one."""
        stillness = self._stillness.judge(samples, start, stop)
        if self._detector[:3] == self._stillness[:3]:
            return stillness, stillness
        return stillness, self._detector.judge(samples, start, stop)

    def _keep_what_later_windows_need(self, samples: ImuBlock, judged: int) -> None:
        oldest_ns = samples.stamp_ns[judged:][:1] - self._half_window_ns
        first = int(np.searchsorted(samples.stamp_ns, oldest_ns[0])) if len(oldest_ns) else judged
        first = max(0, min(first, judged - 1))  # the one before belongs to the window
        self._samples, self._unjudged = part(samples, first), judged - first

    def _forget(self) -> None:
        """Start anew: no sample waits for a verdict, no swing is remembered."""
        self._samples, self._unjudged = NO_SAMPLES, 0
        self._threshold = relative_threshold.fresh_threshold()
        self._gate = self._fresh_gate()
