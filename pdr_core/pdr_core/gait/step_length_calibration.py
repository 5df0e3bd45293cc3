"""A person's stride length: learned while the gyro is on, used while it is off (Zhou sections 2.2, 5).

Strides of one behaviour whose frequencies lie together, within Zhou's +-0.2 (the print has no unit: read as Hz), make a
group with coefficients of its own: a person walks in two or three manners. A stride that fits no group opens a new one.
"""

from collections.abc import Sequence
from math import hypot, isnan, sqrt

import numpy as np

from pdr_core.gait.least_squares import LeastSquares
from pdr_core.gait.step_length.catalogue import model_of
from pdr_core.gait.step_length.model import Model
from pdr_core.maths.compiled import compiled
from pdr_core.params import GaitParams
from pdr_core.records import Floats
from pdr_core.records_gait import Behaviour, GaitStep

LONGEST_M = 6.0  # of a sprinter's stride; what is longer was not measured right
LONGEST_WALKED_M = 2.2  # at 2.5 m/s, where walking ends. A runner's last stride looks like one of a walk
UNCALIBRATED_SD_M = 0.3  # how far people differ from the prior
PRIOR_STRIDES = 4  # the prior deviation of a model counts as much as so many strides


class Group:
    """Strides of one manner."""

    def __init__(self, model: Model, params: GaitParams) -> None:
        self.model = model
        self._params = params
        self._squares = LeastSquares(np.array(model.prior), np.array(model.prior_sd), PRIOR_STRIDES)
        self._frequencies_hz = 0.0  # their sum
        self._lengths_m = 0.0
        self._estimate = self._squares.estimate()

    @property
    def strides(self) -> int:
        """How many it has learned from."""
        return self._squares.count

    @property
    def frequency_hz(self) -> float:
        """Their mean frequency."""
        return self._frequencies_hz / self.strides

    @property
    def coefficients(self) -> Floats:
        """Those of the model, (k,)."""
        return self._estimate.coefficients

    def learn(self, step: GaitStep, length_m: float, length_sd_m: float) -> None:
        """Take a stride whose length is known."""
        self._squares.add(self.model.terms(step), length_m, float(np.hypot(self._params.model_sd_m, length_sd_m)))
        self._frequencies_hz += step.frequency_hz
        self._lengths_m += length_m
        self._estimate = self._squares.estimate()

    @property
    def stride_sd_m(self) -> float:
        """How far single strides differ from the model: what they show, and at first what models usually do."""
        prior_m, shown_m = self._params.model_sd_m, self._estimate.residual_sd
        if isnan(shown_m):
            return prior_m
        mean_m2 = (PRIOR_STRIDES * prior_m**2 + self.strides * shown_m**2) / (PRIOR_STRIDES + self.strides)
        return sqrt(mean_m2)

    def length(self, step: GaitStep) -> tuple[float, float]:
        """Return the length of a stride and its deviation [m]: of the stride itself and of the coefficients."""
        terms = self.model.terms(step)
        length_m, variance_m2 = combined(terms, self.coefficients, self._estimate.covariance)
        return min(max(length_m, 0.0), longest(step)), hypot(self.stride_sd_m, sqrt(variance_m2))

    @property
    def ready(self) -> bool:
        """It has seen enough strides, and they agree with it."""
        enough = self.strides >= self._params.ready_strides
        return enough and self.stride_sd_m <= self._params.ready_share * self._lengths_m / self.strides


@compiled
def combined(terms: Floats, coefficients: Floats, covariance: Floats) -> tuple[float, float]:
    """Return the sum of terms (k,) times coefficients and its variance."""
    value, variance = 0.0, 0.0
    for i in range(terms.shape[0]):
        value += terms[i] * coefficients[i]
        for j in range(terms.shape[0]):
            variance += terms[i] * covariance[i, j] * terms[j]
    return value, max(0.0, variance)


def longest(step: GaitStep) -> float:
    """Return the length [m] that no such stride exceeds, whatever a model says beyond what it has seen."""
    return LONGEST_WALKED_M if step.behaviour is Behaviour.WALKING else LONGEST_M


class StepLength:
    """Strides with their lengths in, lengths of other strides out."""

    def __init__(self, params: GaitParams) -> None:
        self._params = params
        self._groups: dict[Behaviour, list[Group]] = {}

    def learn(self, step: GaitStep, length_m: float, length_sd_m: float) -> None:
        """Take a stride whose length the ZUPT filter has measured; one that no person makes is not believed."""
        if not (0.0 < length_m < LONGEST_M and 0.0 <= length_sd_m < LONGEST_M):
            return
        group = self.group(step)
        if group is None:
            group = Group(model_of(self._params.step_model, step.behaviour), self._params)
            self._groups.setdefault(step.behaviour, []).append(group)
        group.learn(step, length_m, length_sd_m)

    def length(self, step: GaitStep) -> tuple[float, float]:
        """Return the length of a stride and its standard deviation [m]; that of a stranger in no group."""
        group = self.group(step)
        if group is not None:
            return group.length(step)
        stranger = Group(model_of(self._params.step_model, step.behaviour), self._params)
        return stranger.length(step)[0], UNCALIBRATED_SD_M

    def ready(self, step: GaitStep) -> bool:
        """Return whether strides such as this one are known well enough to walk without the gyro."""
        group = self.group(step)
        return group is not None and group.ready

    def forget(self, step: GaitStep) -> None:
        """Begin anew with strides such as this one: the examination has failed."""
        group = self.group(step)
        if group is not None:
            self._groups[step.behaviour].remove(group)

    def group(self, step: GaitStep) -> Group | None:
        """Return the group that a stride belongs to: the one of nearest frequency, if it is near enough."""
        groups = self._groups.get(step.behaviour, [])
        nearest = min(groups, key=lambda g: abs(g.frequency_hz - step.frequency_hz), default=None)
        near = nearest is not None and abs(nearest.frequency_hz - step.frequency_hz) <= self._params.group_hz
        return nearest if near else None


def calibrated_offline(
    model: Model, steps: Sequence[GaitStep], lengths_m: Sequence[float], params: GaitParams
) -> Group:
    """Return a model fitted to known strides at once, whatever their behaviour and frequency (Zhou figure 16)."""
    group = Group(model, params)
    for step, length_m in zip(steps, lengths_m, strict=True):
        group.learn(step, length_m, 0.0)
    return group
