"""The same strides by the filter and by dead reckoning, for who wants to know what a step costs.

Both begin with samples that the intake has passed. The filter has its stance detector; ours recognises what the foot
does, finds its strides and stands, tells length, turn and heading, and reckons, with a model that has learnt before.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pdr_core.bench.zhou_lesson import learn, navigated
from pdr_core.bench.zhou_schemes import without_rates
from pdr_core.bench.zhou_walks import MAGNETOMETER_HZ, pieces, stands_s, told
from pdr_core.eskf import ZuptFilter
from pdr_core.gait.dead_reckoning import GaitDeadReckoning
from pdr_core.intake import Ingestion
from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline.gait_model import GaitModel
from pdr_core.pipeline.gait_watch import GaitWatch
from pdr_core.records import Handover, ImuBlock
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.walk import personal_strides
from pdr_core.stance import StanceDetection

PIECE_S = 0.5
LEARN_HZ, LEARN_M = 50, 15.0  # enough for a model that costs what any model costs
FIRST, LAST = 4, 2  # strides before what counts, and after it


@dataclass(frozen=True)
class Prepared:
    """A short walk, and a model that has learnt from another one."""

    params: Params
    before: list[ImuBlock]  # samples of the rest and the first strides
    counted: list[ImuBlock]
    strides: int  # in these
    model: GaitModel
    start: Handover


def prepared(rate_hz: int, length_m: float) -> Prepared:
    """Walk, and let a model learn at the filter's rate."""
    params, simulated = told(), walk_of(length_m, rate_hz)
    strides = personal_strides(simulated)
    stand_ns = np.round(stands_s(strides) * 1e9).astype(np.int64)
    imu = Ingestion(params.intake).run(simulated_walk(simulated).imu)
    rows = np.searchsorted(imu.stamp_ns, stand_ns[[FIRST, len(strides) - LAST]])
    before, counted = (ImuBlock._make(c[a:b] for c in imu) for a, b in ((0, rows[0]), (rows[0], rows[1])))
    model, start = learnt(params)
    first, rest = (pieces(block, PIECE_S, rate_hz) for block in (before, counted))
    return Prepared(params, first, rest, len(strides) - LAST - FIRST, model, start)


def learnt(params: Params) -> tuple[GaitModel, Handover]:
    """Return a model that has learnt from a short walk."""
    imu = simulated_walk(walk_of(LEARN_M, LEARN_HZ)).imu
    samples = pieces(Ingestion(params.intake).run(imu), PIECE_S, LEARN_HZ)
    nav, steps = navigated(params, samples)
    watch, model = GaitWatch(params), GaitModel(params)
    return model, learn(model, [stride for piece in samples for stride in watch.run(piece).strides], nav, steps)


def walk_of(length_m: float, rate_hz: int) -> SimulationParams:
    """Return the parameters of a straight walk; a low rate is not filtered, for nothing but the cost counts."""
    return SimulationParams(
        motion="smooth",
        walk="straight",
        walk_length_m=length_m,
        tester="a",
        sample_rate_hz=float(rate_hz),
        magnetometer=True,
        magnetometer_rate_hz=MAGNETOMETER_HZ,
    )


def by_filter(walk: Prepared) -> Callable[[], object]:
    """Return what takes the strides that count by stance detector and filter."""
    p = walk.params
    stance, zupt = StanceDetection(p.stance, p.place, p.detectors), ZuptFilter(p.filter, p.place)

    def take(samples: list[ImuBlock]) -> None:
        for piece in samples:
            zupt.run(stance.run(piece))

    take(walk.before)
    return lambda: take(walk.counted)


def by_strides(walk: Prepared) -> Callable[[], object]:
    """Return what takes them by dead reckoning."""
    watch, reckoning = GaitWatch(walk.params), GaitDeadReckoning(walk.params.dead_reckoning)
    reckoning.begin(walk.start)

    def take(samples: list[ImuBlock]) -> None:
        for piece in samples:
            for stride in watch.run(piece).strides:
                reckoning.step(stride.step, *walk.model.told(stride))

    take([without_rates(piece) for piece in walk.before])
    blind = [without_rates(piece) for piece in walk.counted]
    return lambda: take(blind)


METHODS = {"ZUPT-KF": by_filter, "ours": by_strides}
