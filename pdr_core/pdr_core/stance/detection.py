"""The stance stage: samples in, samples with a verdict out, delayed by the look-ahead that the verdict needs."""

from itertools import pairwise

import numpy as np

from pdr_core.conventions import NANOSECONDS, gravity_mps2
from pdr_core.params import PlaceParams, StanceParams
from pdr_core.records import Flags, Floats, ImuBlock, StanceBlock, joined, length, part
from pdr_core.stance import gait_gate, glrt, rest


class StanceDetection:
    """GLRT with a time threshold and gait classification (Gui section 3), and the soft rest test.

    A verdict needs half a window of later samples, and where a stance begins as long as a stance must last. So
    `latency_s` is the longest time by which a verdict follows its sample.
    """

    def __init__(self, params: StanceParams, place: PlaceParams) -> None:
        self._params = params
        self._gravity_mps2 = gravity_mps2(np.radians(place.latitude_deg), place.height_m)
        self._half_window_ns = nanoseconds(params.window_s / 2.0)
        self._gate_limits = gait_gate.GateLimits(
            params.threshold,
            params.threshold * params.toe_off_ratio,
            nanoseconds(params.stance_min_s),
            nanoseconds(params.dip_max_s),
            nanoseconds(params.swing_min_s),
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
        )
        self._gate = gait_gate.fresh_state()
        self._rest = rest.fresh_state()
        self._forget()

    @property
    def latency_s(self) -> float:
        """The longest time [s] from a sample to its verdict."""
        return self._params.window_s / 2.0 + max(self._params.stance_min_s, self._params.dip_max_s)

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
        return self._judge(part(self._samples, 0, 0), final=True)

    def _judge(self, imu: ImuBlock, final: bool) -> StanceBlock:
        samples = joined([self._samples, imu])
        statistic = self._with_statistic(samples, final)
        verdict, decided = self._gated(samples, statistic, final)
        out = part(samples, self._undecided, decided)
        rest_rate, rest_sd = rest.rests(out, self._rest_limits, self._rest)
        judged = StanceBlock(
            out,
            verdict,
            statistic[self._undecided : decided],
            np.full(length(out), self._params.threshold),
            rest_rate,
            rest_sd,
        )
        self._keep_what_later_windows_need(samples, statistic, decided)
        return judged

    def _with_statistic(self, samples: ImuBlock, final: bool) -> Floats:
        """Return the statistic of all samples whose window is complete."""
        complete = length(samples)
        if complete and not final:
            last_ns = samples.stamp_ns[-1] - self._half_window_ns
            complete = int(np.searchsorted(samples.stamp_ns, last_ns, side="right"))
        p, known = self._params, len(self._statistic)
        new = glrt.statistics(
            samples, known, complete, self._half_window_ns, self._gravity_mps2, p.accel_sd_mps2, p.gyro_sd_radps
        )
        return np.concatenate([self._statistic, new])

    def _gated(self, samples: ImuBlock, statistic: Floats, final: bool) -> tuple[Flags, int]:
        """Return the verdicts that are known now, and up to which sample."""
        window = slice(self._undecided, len(statistic))
        verdict = np.empty(len(statistic) - self._undecided, np.bool_)
        count = gait_gate.decide(
            samples.stamp_ns[window], statistic[window], self._gate_limits, self._gate, final, verdict
        )
        return verdict[:count], self._undecided + count

    def _keep_what_later_windows_need(self, samples: ImuBlock, statistic: Floats, decided: int) -> None:
        first = decided
        if len(statistic) < length(samples):
            oldest_ns = samples.stamp_ns[len(statistic)] - self._half_window_ns
            first = min(decided, int(np.searchsorted(samples.stamp_ns, oldest_ns)))
        self._samples, self._statistic, self._undecided = part(samples, first), statistic[first:], decided - first

    def _forget(self) -> None:
        """Start anew: no sample waits for a verdict."""
        none, empty = np.zeros(0), np.zeros((0, 3))
        self._samples = ImuBlock(np.zeros(0, np.int64), empty, empty, none, none)
        self._statistic = none
        self._undecided = 0


def nanoseconds(time_s: float) -> int:
    """Return a time [s] in whole nanoseconds."""
    return round(time_s * NANOSECONDS)
