"""The stance stage: samples in, samples with a verdict out, delayed by the half window that the statistic needs."""

from itertools import pairwise

import numpy as np

from pdr_core.conventions import NANOSECONDS, gravity_mps2
from pdr_core.params import PlaceParams, StanceParams
from pdr_core.records import NO_SAMPLES, Floats, ImuBlock, StanceBlock, joined, length, part
from pdr_core.stance import glrt, relative_threshold, rest


class StanceDetection:
    """GLRT (Gui eq. 8) with a threshold relative to the last swing, and the soft rest test.

    A verdict needs half a window of later samples: `latency_s` is the longest time by which it follows its sample.
    """

    def __init__(self, params: StanceParams, place: PlaceParams) -> None:
        self._params = params
        self._gravity_mps2 = gravity_mps2(np.radians(place.latitude_deg), place.height_m)
        self._half_window_ns = nanoseconds(params.window_s / 2.0)
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
        """The longest time [s] from a sample to its verdict."""
        return self._params.window_s / 2.0

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
        statistic = self._statistics(samples, final)
        out = part(samples, first, first + len(statistic))
        threshold, sd_mps = relative_threshold.thresholds(
            out.stamp_ns, statistic, self._threshold_limits, self._threshold
        )
        rest_rate, rest_sd = rest.rests(out, self._rest_limits, self._rest)
        self._keep_what_later_windows_need(samples, first + len(statistic))
        return StanceBlock(out, statistic <= threshold, statistic, threshold, sd_mps, rest_rate, rest_sd)

    def _statistics(self, samples: ImuBlock, final: bool) -> Floats:
        """Return the statistic of all unjudged samples whose window is complete."""
        complete = length(samples)
        if complete and not final:
            last_ns = samples.stamp_ns[-1] - self._half_window_ns
            complete = int(np.searchsorted(samples.stamp_ns, last_ns, side="right"))
        p = self._params
        return glrt.statistics(
            samples,
            self._unjudged,
            complete,
            self._half_window_ns,
            self._gravity_mps2,
            p.accel_sd_mps2,
            p.gyro_sd_radps,
        )

    def _keep_what_later_windows_need(self, samples: ImuBlock, judged: int) -> None:
        oldest_ns = samples.stamp_ns[judged:][:1] - self._half_window_ns
        first = int(np.searchsorted(samples.stamp_ns, oldest_ns[0])) if len(oldest_ns) else judged
        self._samples, self._unjudged = part(samples, first), judged - first

    def _forget(self) -> None:
        """Start anew: no sample waits for a verdict, no swing is remembered."""
        self._samples, self._unjudged = NO_SAMPLES, 0
        self._threshold = relative_threshold.fresh_threshold()


def nanoseconds(time_s: float) -> int:
    """Return a time [s] in whole nanoseconds."""
    return round(time_s * NANOSECONDS)
