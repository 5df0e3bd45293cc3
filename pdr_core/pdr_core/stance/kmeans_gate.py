"""Qiu's adaptive time constraint (section 2.3, figure 5): the durations of the phases tell true stances from false.

The rests that a detector finds fall into two clusters by their duration, true stances and short fluctuations; k-means
finds them, and the limit lies between the extreme values of the two. As printed, on raw durations, the first long rest
becomes the "true" cluster and all steps are dropped. So here

- the durations are taken as logarithms, capped at `CAP_S`: a pause is not more of a stance than a step,
- the first phase and the one that has not ended yet do not count: they are rests of any length,
- two clusters must be apart by the factor `APART`: a walk without fluctuations has one, and all of it is true,
- the limit is at most `longest_s`, and where no stance was found for `lockout_s` the next rest is one, whatever its
  length: walkers that begin to run, whose stances are short, are not locked out.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP, nanoseconds
from pdr_core.maths.compiled import compiled
from pdr_core.params import DetectorParams
from pdr_core.records import Flags, Floats, Stamps
from pdr_core.stance.time_gate import TimeGate, after_gap, lasts

SHORTEST_S, CAP_S = 0.001, 1.0
APART = 3.0
FEWEST, MOST = 8, 100  # phases that are looked at
NOT_ENDED = -1


class PhaseState(NamedTuple):
    """The memory of the gate, up to the last decided sample."""

    begin_ns: Stamps  # (1,) of the phase that goes on, or NO_STAMP
    true: Flags  # (1,) it is a stance
    last_ns: Stamps  # (1,) stamp of the last sample, or NO_STAMP
    stance_ns: Stamps  # (1,) stamp of the last sample in stance, or NO_STAMP


class KmeansGate(TimeGate):
    """Lets through phases of the true cluster: of those so far, or of all, where they are known beforehand."""

    def __init__(self, params: DetectorParams, phases_s: Floats | None = None) -> None:
        super().__init__()
        self.latency_s = params.kmeans_longest_s
        self._longest_s = params.kmeans_longest_s
        self._lockout_ns = nanoseconds(params.kmeans_lockout_s)
        self._known = phases_s is not None
        self._phases_s = phases_s if phases_s is not None else np.zeros(0)
        self._limit_ns = self._limit()
        self._state = fresh_state()
        self._first = True

    def decide(self, stamp_ns: Stamps, resting: Flags, final: bool) -> Flags:
        """Return which of the first samples are in stance."""
        verdicts = np.zeros(len(stamp_ns), np.bool_)
        at, ended_ns = 0, 0
        while ended_ns != NOT_ENDED:
            at, ended_ns = decide_phase(
                stamp_ns, resting, at, self._limit_ns, self._lockout_ns, final, self._state, verdicts
            )
            if ended_ns != NOT_ENDED:
                self._learn(ended_ns / NANOSECONDS)
        return verdicts[:at]

    def _learn(self, duration_s: float) -> None:
        """Take the duration of a phase that has ended."""
        if not (self._first or self._known):
            self._phases_s = np.append(self._phases_s, duration_s)[-MOST:]
            self._limit_ns = self._limit()
        self._first = False

    def _limit(self) -> int:
        return nanoseconds(min(shortest_true_s(self._phases_s), self._longest_s))


def fresh_state() -> PhaseState:
    """Return the memory of a gate that has seen nothing."""
    return PhaseState(
        np.full(1, NO_STAMP, np.int64),
        np.zeros(1, np.bool_),
        np.full(1, NO_STAMP, np.int64),
        np.full(1, NO_STAMP, np.int64),
    )


def shortest_true_s(phases_s: Floats) -> float:
    """Return the duration [s] between the false and the true ones of some phases, (n,) [s]; 0 where all are true."""
    if len(phases_s) < FEWEST:
        return 0.0
    logs = np.log(np.clip(phases_s, SHORTEST_S, CAP_S))
    ends = np.array([[logs.min()], [logs.max()]])
    if ends[1, 0] - ends[0, 0] < np.log(APART):
        return 0.0
    from scipy.cluster.vq import kmeans2  # takes a while to load, and few need it

    centres, cluster = kmeans2(logs[:, None], ends, minit="matrix")
    if centres[1, 0] - centres[0, 0] < np.log(APART):
        return 0.0
    return float(np.exp((logs[cluster == 0].max() + logs[cluster == 1].min()) / 2.0))


@compiled
def decide_phase(
    stamp_ns: Stamps,
    resting: Flags,
    at: int,
    limit_ns: int,
    lockout_ns: int,
    final: bool,
    state: PhaseState,
    verdicts: Flags,
) -> tuple[int, int]:
    """Write the verdicts from sample `at` on, until a phase has ended or is not certain yet.

    Return the next sample and how long the phase lasted that has ended [ns], or NOT_ENDED.
    """
    for i in range(at, stamp_ns.shape[0]):
        if after_gap(stamp_ns[i], state.last_ns[0]):
            state.begin_ns[0] = NO_STAMP
        if not resting[i] and state.begin_ns[0] != NO_STAMP:
            ended_ns = state.last_ns[0] - state.begin_ns[0]
            state.begin_ns[0] = NO_STAMP
            return i, ended_ns
        if resting[i] and state.begin_ns[0] == NO_STAMP:
            locked_out = state.stance_ns[0] == NO_STAMP or stamp_ns[i] - state.stance_ns[0] > lockout_ns
            enough, certain = lasts(stamp_ns, resting, i, 0 if locked_out else limit_ns)
            if not (certain or final):
                return i, NOT_ENDED
            state.begin_ns[0], state.true[0] = stamp_ns[i], enough
        verdicts[i] = resting[i] and state.true[0]
        if verdicts[i]:
            state.stance_ns[0] = stamp_ns[i]
        state.last_ns[0] = stamp_ns[i]
    return stamp_ns.shape[0], NOT_ENDED
