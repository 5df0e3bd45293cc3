"""Gui's gait classification with a time threshold (section 3): a dip of the statistic in mid-swing is no stance.

A stride has four phases (figure 2), here told by the detector's verdicts and by time:

    stance       the foot rests
    toe-off      it has begun to move; if it rests again within `toe_off_s`, it has only wobbled
    swing        it is in the air until `swing_min_s` after the toe-off, the shortest swing there is
    heel strike  it may come down: the next rest is a stance

In mid-swing the foot moves evenly for an instant and the statistic dips below the threshold (figure 3). Such a dip is
short. So a rest within the swing must last for `dip_max_s`, the time threshold, to be a stance after all: a foot that
stands is never locked out. Gui gives no figure for it, nor says whether it holds for every stance. Here it does not:
after the swing a rest is a stance, however short. Runners stand for no longer than a dip lasts, and a threshold of
0.02 s on every stance already loses strides.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.maths.compiled import compiled
from pdr_core.params import DetectorParams
from pdr_core.records import Flags, Stamps
from pdr_core.stance.time_gate import TimeGate, after_gap, lasts

STANCE, TOE_OFF, SWING, HEEL_STRIKE = 0, 1, 2, 3


class GaitLimits(NamedTuple):
    """The times that tell the phases apart."""

    toe_off_ns: int
    swing_min_ns: int
    dip_max_ns: int


class GaitState(NamedTuple):
    """The memory of the classification, up to the last decided sample."""

    phase: Stamps  # (1,)
    dip: Flags  # (1,) the foot rests, but that is no stance
    toe_off_ns: Stamps  # (1,) when the last stance ended
    last_ns: Stamps  # (1,) stamp of the last sample, or NO_STAMP


class GaitPhases(TimeGate):
    """Lets through what rests in the stance phase."""

    def __init__(self, params: DetectorParams) -> None:
        super().__init__()
        self.latency_s = params.gait_phases_dip_max_s
        self._limits = GaitLimits(
            nanoseconds(params.gait_phases_toe_off_s),
            nanoseconds(params.gait_phases_swing_min_s),
            nanoseconds(params.gait_phases_dip_max_s),
        )
        self._state = fresh_state()

    def decide(self, stamp_ns: Stamps, resting: Flags, final: bool) -> Flags:
        """Return which of the first samples are in stance."""
        return phases(stamp_ns, resting, self._limits, self._state, final) == STANCE


def fresh_state() -> GaitState:
    """Return the memory of a classification that has seen nothing: any rest is a stance."""
    return GaitState(
        np.full(1, HEEL_STRIKE), np.zeros(1, np.bool_), np.zeros(1, np.int64), np.full(1, NO_STAMP, np.int64)
    )


@compiled
def phases(stamp_ns: Stamps, resting: Flags, limits: GaitLimits, state: GaitState, final: bool) -> Stamps:
    """Return the phases of the first samples, those that are certain: (m,) of (n,); of all if `final`."""
    n = stamp_ns.shape[0]
    out = np.empty(n, np.int64)
    for i in range(n):
        if after_gap(stamp_ns[i], state.last_ns[0]):
            state.phase[0], state.dip[0] = HEEL_STRIKE, False
        if not resting[i]:
            move(stamp_ns[i], limits, state)
        elif state.phase[0] != STANCE and not state.dip[0]:
            enough, certain = lasts(stamp_ns, resting, i, limits.dip_max_ns if state.phase[0] == SWING else 0)
            if not (certain or final):
                return out[:i]
            state.dip[0] = not enough
            if enough:
                state.phase[0] = STANCE
        state.last_ns[0] = stamp_ns[i]
        out[i] = state.phase[0]
    return out


@compiled
def move(stamp_ns: int, limits: GaitLimits, state: GaitState) -> None:
    """Take a sample of a foot that moves: time leads from one phase to the next."""
    state.dip[0] = False
    if state.phase[0] == STANCE:
        state.phase[0], state.toe_off_ns[0] = TOE_OFF, stamp_ns
    since_ns = stamp_ns - state.toe_off_ns[0]
    if state.phase[0] == TOE_OFF and since_ns >= limits.toe_off_ns:
        state.phase[0] = SWING
    if state.phase[0] == SWING and since_ns >= limits.swing_min_ns:
        state.phase[0] = HEEL_STRIKE
