"""Zhou's figure 16: the length of every stride over walking, running, walking, by all models.

The classical models are calibrated offline: on another walk of the same person with the same changes, to the true
lengths of its strides, whatever they are, at once. Ours knows nothing before: while it calibrates, over L0 of each
gait, the ZUPT filter's own lengths are those of the suite; from then on it tells them.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pdr_core.bench.zhou_lesson import PIECE_S, navigated
from pdr_core.bench.zhou_modes import RATE_HZ, STRIDING, TRANSITIONS_M, simulation
from pdr_core.bench.zhou_walks import pieces, stands_s, told
from pdr_core.gait.accelerometer_steps import AccelerometerSteps
from pdr_core.gait.step_length.catalogue import MODELS
from pdr_core.gait.step_length_calibration import StepLength, calibrated_offline
from pdr_core.gait.stride_pairing import paired
from pdr_core.params import Params
from pdr_core.pipeline.gait_model import length_sd_m
from pdr_core.records import Floats, StepEvent
from pdr_core.records_gait import GaitStep
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.walk import personal_strides

CLASSICAL = ("constant", "frequency_linear", "weinberg", "kim")
OURS = "ours"
NEAR = 4  # strides after a change
OFFLINE_SEED = 1000  # added to that of the walk


class Walked(NamedTuple):
    """The walked and run strides of one walk."""

    steps: list[GaitStep]
    true_m: Floats  # (strides,)
    measured: list[StepEvent | None]  # by the filter


class Lengths(NamedTuple):
    """What figure 16 shows."""

    stride: Floats  # (strides,)
    true_m: Floats
    by_model: dict[str, Floats]
    by_filter: list[bool]  # ours was calibrating


@dataclass(frozen=True)
class LengthError:
    """One model on one walk."""

    model: str
    tester: str
    seed: int
    rms_cm: float
    near_changes_rms_cm: float  # in the first strides of a gait
    distance_percent: float  # signed


def walked(tester: str, seed: int, params: Params) -> Walked:
    """Walk, and see the strides by the filter and by the accelerometer."""
    simulated = simulation("transitions", TRANSITIONS_M, tester, seed)
    walk, strides = simulated_walk(simulated), personal_strides(simulated)
    rows = np.round(stands_s(strides) * RATE_HZ).astype(np.int64)
    stand_ns, stand_m = walk.imu.stamp_ns[rows], walk.motion.position_m[rows, :2]
    shown = [s for s in AccelerometerSteps(params.gait).run(walk.imu).steps if s.behaviour in STRIDING]
    ends = [int(np.argmin(np.abs(stand_ns - step.stamp_ns))) for step in shown]
    measured = {
        gait.index: step for gait, step in paired(shown, navigated(params, pieces(walk.imu, PIECE_S, RATE_HZ))[1])
    }
    true_m = np.array([np.linalg.norm(stand_m[i] - stand_m[i - 1]) for i in ends])
    return Walked(shown, true_m, [measured.get(step.index) for step in shown])


def online(walk: Walked, params: Params) -> tuple[Floats, list[bool]]:
    """Return the lengths of ours, and where the filter has told them."""
    model, walked_m, lengths_m, by_filter = StepLength(params.gait), dict.fromkeys(STRIDING, 0.0), [], []
    for step, measured in zip(walk.steps, walk.measured, strict=True):
        calibrates = walked_m[step.behaviour] < params.power.calibration_m and measured is not None
        lengths_m.append(measured.length_m if calibrates and measured else model.length(step)[0])
        by_filter.append(calibrates)
        if calibrates and measured:
            walked_m[step.behaviour] += measured.length_m
            model.learn(step, measured.length_m, length_sd_m(measured))
    return np.array(lengths_m), by_filter


def figure_16(tester: str, seed: int) -> tuple[list[LengthError], Lengths]:
    """Return the lengths by all models and how far they are off."""
    params = told()
    walk, before = walked(tester, seed, params), walked(tester, seed + OFFLINE_SEED, params)
    by_model = {}
    for name in CLASSICAL:
        group = calibrated_offline(MODELS[name], before.steps, before.true_m.tolist(), params.gait)
        by_model[name] = np.array([group.length(step)[0] for step in walk.steps])
    by_model[OURS], by_filter = online(walk, params)
    errors = [error(name, tester, seed, walk, lengths_m) for name, lengths_m in by_model.items()]
    return errors, Lengths(np.arange(len(walk.steps), dtype=np.float64), walk.true_m, by_model, by_filter)


def error(name: str, tester: str, seed: int, walk: Walked, lengths_m: Floats) -> LengthError:
    """Return how far one model is off."""
    off_m = lengths_m - walk.true_m
    gaits = [step.behaviour for step in walk.steps]
    begun = [i for i, (now, before) in enumerate(zip(gaits, [None, *gaits], strict=False)) if now is not before]
    near = [i for first in begun for i in range(first, min(first + NEAR, len(off_m)))]
    return LengthError(
        name,
        tester,
        seed,
        100.0 * float(np.sqrt(np.mean(off_m**2))),
        100.0 * float(np.sqrt(np.mean(off_m[near] ** 2))),
        100.0 * float(lengths_m.sum() / walk.true_m.sum() - 1.0),
    )
