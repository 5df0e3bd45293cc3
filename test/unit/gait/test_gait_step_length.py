"""Models of a stride's length, and their calibration: groups, honesty, readiness, examination."""

from dataclasses import replace

import numpy as np
import pytest

from pdr_core.gait.step_length import model_of
from pdr_core.gait.step_length.catalogue import MODELS
from pdr_core.gait.step_length_calibration import LONGEST_WALKED_M, StepLength, calibrated_offline
from pdr_core.gait.stride_pairing import paired
from pdr_core.parameter import choices_of
from pdr_core.params import GaitParams
from pdr_core.records import StepEvent
from pdr_core.records_gait import Behaviour, GaitStep

PARAMS = GaitParams()
STEP = GaitStep(1, 0, 10**9, Behaviour.WALKING, 0.81, 3.0, 12.0, -4.0, 3.375)
RUN = replace(STEP, behaviour=Behaviour.RUNNING, frequency_hz=1.3, accel_mean_abs_mps2=8.0)
EVERY = pytest.mark.parametrize("name", MODELS)


def some(count: int, seed: int = 1, **fixed: object) -> list[GaitStep]:
    """Strides of a person: frequency and acceleration vary."""
    rng = np.random.default_rng(seed)
    drawn = [
        replace(STEP, index=i + 1, frequency_hz=0.85 + 0.04 * x, accel_mean_abs_mps2=3.5 + 0.6 * y)
        for i, (x, y) in enumerate(rng.standard_normal((count, 2)))
    ]
    return [replace(step, **fixed) for step in drawn]


def true_m(step: GaitStep) -> float:
    return 0.1 + 0.2 * step.accel_mean_abs_mps2 + 0.5 / step.frequency_hz


def taught(steps: list[GaitStep], noise_m: float = 0.0, seed: int = 2, params: GaitParams = PARAMS) -> StepLength:
    model, noise = StepLength(params), np.random.default_rng(seed).standard_normal(len(steps))
    for step, error in zip(steps, noise, strict=True):
        model.learn(step, true_m(step) + noise_m * error, 0.01)
    return model


@pytest.mark.parametrize(
    ("name", "terms"),
    [
        ("constant", [1.0]),
        ("frequency_linear", [1.0, 0.81]),
        ("weinberg", [2.0]),
        ("kim", [1.5]),
        ("zhou", [1.0, 3.375, 1.0 / 0.81, 1.0 / 0.9]),
    ],
)
def test_formulas(name: str, terms: list[float]) -> None:
    model = model_of(name, Behaviour.WALKING)
    assert model.terms(STEP) == pytest.approx(terms)
    assert len(model.prior) == len(model.prior_sd) == len(terms)
    assert 0.9 < model.terms(STEP) @ model.prior < 1.7  # a stranger's stride


def test_zhou_runs_with_a_formula_of_its_own() -> None:
    assert model_of("zhou", Behaviour.RUNNING).terms(RUN) == pytest.approx([2.0])
    assert model_of("kim", Behaviour.RUNNING) is model_of("kim", Behaviour.WALKING)


def test_every_model_can_be_chosen() -> None:
    assert set(choices_of(GaitParams, "step_model")) == set(MODELS)


@EVERY
@pytest.mark.parametrize("behaviour", Behaviour)
def test_every_model_gives_a_length_before_and_after(name: str, behaviour: Behaviour) -> None:
    model = StepLength(replace(PARAMS, step_model=name))
    step = replace(STEP, behaviour=behaviour)
    for _ in range(12):
        length_m, sd_m = model.length(step)
        assert 0.5 < length_m < 2.5
        assert 0.0 < sd_m < 1.0
        model.learn(step, 1.3, 0.01)
    assert model.length(step)[0] == pytest.approx(1.3, abs=0.02)
    assert model.ready(step)


def test_a_person_is_learned_and_others_of_his_strides_predicted() -> None:
    model = taught(some(400))
    for step in some(40, seed=3):
        assert model.length(step)[0] == pytest.approx(true_m(step), abs=0.03)


def test_strides_all_alike_leave_the_other_coefficients_at_their_priors() -> None:
    model = taught([STEP] * 30)
    group = model.group(STEP)
    assert group is not None
    assert group.coefficients[1:].tolist() == [0.25, 0.6, 0.0]
    assert model.length(STEP)[0] == pytest.approx(true_m(STEP), abs=1e-3)


def test_it_says_how_far_off_it_is() -> None:
    normalised = []
    for seed in range(60):
        model = taught(some(20, seed), noise_m=0.1, seed=seed + 1000)
        for step in some(5, seed + 2000):
            length_m, sd_m = model.length(step)
            error_m = length_m - true_m(step) - 0.1 * np.random.default_rng([seed, step.index]).standard_normal()
            normalised.append(error_m / sd_m)
    assert 0.85 < np.std(normalised) < 1.15


def test_groups_by_frequency_and_behaviour() -> None:
    slow, fast = replace(STEP, frequency_hz=0.8), replace(STEP, frequency_hz=1.05)
    model = StepLength(PARAMS)
    for _ in range(12):
        model.learn(slow, 1.1, 0.01)
        model.learn(fast, 1.6, 0.01)
        model.learn(RUN, 2.0, 0.01)
    for step, length_m in ((slow, 1.1), (fast, 1.6), (RUN, 2.0)):
        assert model.length(step)[0] == pytest.approx(length_m, abs=0.02)
        assert model.ready(step)
    assert not model.ready(replace(STEP, frequency_hz=1.3))
    assert not model.ready(replace(STEP, frequency_hz=1.3, behaviour=Behaviour.UNKNOWN))
    assert model.length(replace(STEP, frequency_hz=1.3))[1] >= 0.3


def test_it_is_ready_after_enough_strides_that_agree() -> None:
    model = StepLength(PARAMS)
    for i in range(PARAMS.ready_strides):
        assert not model.ready(STEP), i
        model.learn(STEP, 1.3, 0.01)
    assert model.ready(STEP)
    doubtful = StepLength(PARAMS)
    for i in range(40):
        doubtful.learn(STEP, 0.8 + (i % 2), 0.01)
    assert not doubtful.ready(STEP)


def test_the_deviation_of_a_stride_is_what_strides_have_shown() -> None:
    assert 0.05 < taught(some(30), noise_m=0.05).length(STEP)[1] < 0.1


def test_a_manner_that_is_not_known_is_not_ready() -> None:
    assert not taught(some(30)).ready(RUN)


def test_what_failed_is_forgotten_and_learned_anew() -> None:
    model = taught(some(30))
    model.forget(STEP)
    assert not model.ready(STEP)
    for _ in range(12):
        model.learn(STEP, 0.9, 0.01)
    assert model.length(STEP)[0] == pytest.approx(0.9, abs=0.02)


@pytest.mark.parametrize(("length_m", "sd_m"), [(np.nan, 0.1), (1.3, np.nan), (np.inf, 0.1), (0.0, 0.1), (50.0, 0.1)])
def test_a_length_that_cannot_be_is_not_believed(length_m: float, sd_m: float) -> None:
    model = taught([STEP] * 20)
    before = model.length(STEP)
    model.learn(STEP, length_m, sd_m)
    assert model.length(STEP) == before


def test_a_length_is_never_negative() -> None:
    assert taught(some(30)).length(replace(STEP, accel_mean_abs_mps2=-50.0))[0] == 0.0


@EVERY
def test_offline_is_one_fit_over_all(name: str) -> None:
    steps = [*some(20), *some(20, seed=5, behaviour=Behaviour.RUNNING, frequency_hz=1.3)]
    fitted = calibrated_offline(MODELS[name], steps, [true_m(step) for step in steps], PARAMS)
    errors_m = [fitted.length(step)[0] - true_m(step) for step in steps]
    assert abs(np.mean(errors_m)) < 0.02
    assert fitted.strides == 40


def event(index: int, start_ns: int, stamp_ns: int) -> StepEvent:
    return StepEvent(index, start_ns, stamp_ns, np.zeros(3), np.zeros(3), np.eye(3), 0.0, 0.0)


def test_pairs_are_by_the_ground_hit() -> None:
    hits = [replace(STEP, index=i, stamp_ns=s) for i, s in enumerate([5, 15, 24, 26, 45], 1)]
    events = [event(1, 0, 10), event(2, 10, 20), event(3, 20, 30), event(4, 30, 40), event(5, 40, 50)]
    assert [(a.index, b.index) for a, b in paired(hits, events)] == [(1, 1), (2, 2), (5, 5)]
    assert paired([], events) == []
    assert paired(hits, []) == []


def test_nobody_walks_in_strides_of_a_sprinter() -> None:
    """A runner's last stride ends in a stand, as a walker's: the line of a walk would make it 5 m."""
    fierce = replace(STEP, frequency_hz=1.2, accel_mean_abs_mps2=20.0)
    assert StepLength(PARAMS).length(fierce)[0] == LONGEST_WALKED_M
