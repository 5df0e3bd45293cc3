"""How well the length of a stride is known without the gyro: the first half of a walk calibrates, the second is walked.

While it calibrates, the ZUPT filter and the accelerometer's strides come from the same samples at the full rate. Then
only the accelerometer is left, at a lower rate: so the adaptive de-sampling (Zhou section 4.3) is in the figures.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pdr_core.bench.trial import Walk, outputs
from pdr_core.gait.accelerometer_steps import AccelerometerSteps
from pdr_core.gait.step_length_calibration import StepLength
from pdr_core.gait.stride_pairing import paired
from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.records import Floats, ImuBlock, StepEvent, Truth
from pdr_core.records_gait import GaitStep

MODELS = ("constant", "frequency_linear", "weinberg", "kim", "zhou")
HEAD = f"{'model':<18}{'Hz':>5}{'walk':>24}{'strides':>9}{'rms cm':>8}{'distance %':>12}{'rms / sd':>10}{'ready':>7}"


@dataclass(frozen=True)
class Lengths:
    """A walk as both see it: the filter's steps, the true length of each, and the strides at the full rate."""

    name: str
    steps: list[StepEvent]
    true_m: Floats  # (steps,)
    strides: list[GaitStep]


@dataclass(frozen=True)
class Prediction:
    """The second half of a walk without the gyro."""

    model: str
    rate_hz: float
    name: str
    strides: int  # found
    true_strides: int
    rms_m: float  # of a stride
    distance_error: float  # of the whole half, share; a stride that is not found is missing
    normalised_rms: float  # of the error by its deviation: 1 is honest
    ready: float  # share of the strides at which the model was

    def __str__(self) -> str:
        found = f"{self.strides}/{self.true_strides}"
        errors = f"{100.0 * self.rms_m:>8.1f}{100.0 * self.distance_error:>12.1f}{self.normalised_rms:>10.2f}"
        return f"{self.model:<18}{self.rate_hz:>5.0f}{self.name:>24}{found:>9}{errors}{self.ready:>7.2f}"


def lengths(walk: Walk, params: Params) -> Lengths:
    """Run the filter over a walk; the truth is that of its strides, or else the filter's own."""
    steps = [step for output in outputs(FootInertial(params), walk.pieces) for step in output.steps]
    return Lengths(walk.name, steps, true_lengths_m(walk.truth, steps), strides_of(walk.pieces, params))


def true_lengths_m(truth: Truth | None, steps: Sequence[StepEvent]) -> Floats:
    """Return the true length of each step, (steps,), where every stride's place is known; else what the steps say."""
    if truth is not None and len(truth.position_m) == len(steps) + 1:
        return np.linalg.norm(np.diff(truth.position_m[:, :2], axis=0), axis=1)
    return np.array([step.length_m for step in steps])


def strides_of(pieces: Sequence[ImuBlock], params: Params) -> list[GaitStep]:
    """Return the strides that the accelerometer alone shows."""
    gait = AccelerometerSteps(params.gait)
    return [step for piece in pieces for step in gait.run(piece).steps]


def prediction(known: Lengths, lowered: Sequence[GaitStep], rate_hz: float, model: str, params: Params) -> Prediction:
    """Calibrate on the first half of the steps, and predict those of the second from strides at a lower rate."""
    half = len(known.steps) // 2
    lengths_of = StepLength(replace(params.gait, step_model=model))
    for stride, step in paired(known.strides, known.steps[:half]):
        lengths_of.learn(stride, step.length_m, along_sd_m(step))
    second = paired(lowered, known.steps[half:])
    told = np.array([lengths_of.length(stride) for stride, _ in second])
    true_m = dict(zip([step.index for step in known.steps], known.true_m, strict=True))
    errors_m = told[:, 0] - np.array([true_m[step.index] for _, step in second])
    return Prediction(
        model,
        rate_hz,
        known.name,
        len(second),
        len(known.steps) - half,
        rms(errors_m),
        float(told[:, 0].sum() / known.true_m[half:].sum() - 1.0),
        rms(errors_m / told[:, 1]),
        float(np.mean([lengths_of.ready(stride) for stride, _ in second])),
    )


def along_sd_m(step: StepEvent) -> float:
    """Return the deviation of a step's length: of its displacement along itself."""
    ahead = np.array([np.cos(step.heading_rad), np.sin(step.heading_rad)])
    return float(np.sqrt(ahead @ step.displacement_covariance_m2[:2, :2] @ ahead))


def rms(values: Floats) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(values**2)))
