"""What the figures 4 to 6 and 9 of Cheng show of K: in theory, and one walk by several K."""

from typing import NamedTuple

import numpy as np

from pdr_core.bench.cheng_walks import METHODS, Walked, walk, walked
from pdr_core.chest.loop_error import LoopNoise, rms_rad
from pdr_core.chest.optimal_gain import GainTheory, attitude_error_deg, closed_form, convergence_s, searched
from pdr_core.params import ChestParams, Params, changed
from pdr_core.records import Floats

GAINS: Floats = np.geomspace(1e-7, 1.0, 400).astype(np.float64)
CONVERGED, CORRECTIONS_HZ = 0.1, 50.0  # section 3.2.4
PAPER = GainTheory()
SLOW = GainTheory(period_s=20.0)
FACTORS = (0.0, 0.25, 1.0)  # of the default K; more than 1/s there is none


class TheoryRow(NamedTuple):
    """The objective of eq. 18 for one period."""

    period_s: float
    closed_form: float
    searched: float
    error_deg: float


def theory(periods_s: tuple[float, ...] = (0.5, 1.0, 5.0, 20.0)) -> list[TheoryRow]:
    """Return where the objective has its minimum, by both ways."""
    found = []
    for period_s in periods_s:
        one = GainTheory(period_s=period_s)
        best, error_deg = minimum(one)
        found.append(TheoryRow(period_s, best, searched(one), error_deg))
    return found


def minimum(one: GainTheory) -> tuple[float, float]:
    """Return the K of least objective by the closed form, and the objective there [deg]."""
    best = closed_form(one)
    return best, float(attitude_error_deg(best, one))


def default() -> tuple[float, float]:
    """Return the default K [1/s], and the tilt error that the real loop is expected to have with it [deg]."""
    gain = ChestParams().feedback_per_s
    return gain, float(np.degrees(rms_rad(gain, LoopNoise())))


def convergence_times_s() -> Floats:
    """Return the convergence time for every K of GAINS, (n,) [s]."""
    return convergence_s(GAINS, CORRECTIONS_HZ, CONVERGED)


def by_several_gains() -> list[Walked]:
    """Return case 1 of the first seed by several K."""
    one, default = walk(1, 1), ChestParams().feedback_per_s
    gains = [*(factor * default for factor in FACTORS), 1.0]
    chests = [{**METHODS["ICFWSLC"], "feedback_per_s": gain} for gain in gains]
    return [
        walked(one, f"K = {gain:.2f}/s", changed(Params(), "chest", **chest))
        for gain, chest in zip(gains, chests, strict=True)
    ]
