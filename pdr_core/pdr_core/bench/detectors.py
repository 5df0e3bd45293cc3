"""Every stance detector, with every time gate, on one recording."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from pdr_core.bench.ablation import ablation
from pdr_core.bench.trial import Walk, trial
from pdr_core.bench.windows import window_steps
from pdr_core.evaluation.detector_curves import detector_curves, true_speed
from pdr_core.evaluation.detector_study import Choice, DetectorStudy
from pdr_core.evaluation.walk_score import WalkScore
from pdr_core.parameter import choices_of
from pdr_core.params import Params, StanceParams, changed
from pdr_core.pipeline.stance_phases import OFFLINE, with_time_gate
from pdr_core.records import StanceBlock

DETECTORS = choices_of(StanceParams, "detector")
Seen = Callable[[str], object]


def study(
    walk: Walk, params: Params, detectors: Sequence[str], gates: Sequence[str], deep: bool, seen: Seen = str
) -> DetectorStudy:
    """Run every detector with every gate; `deep`: also windows of every length, and the method without each part.

    What a part is worth only the truth can tell: without it none is left out. `seen` is told what is under way.
    NoSamples if the recording holds no usable one.
    """
    shallow = compared(walk, params, detectors, gates, seen)
    if not deep:
        return shallow
    worth = ablation(walk, params, seen) if walk.truth else {}
    return replace(shallow, windows=window_steps(walk, params, detectors, seen), ablation=worth)


def compared(walk: Walk, params: Params, detectors: Sequence[str], gates: Sequence[str], seen: Seen) -> DetectorStudy:
    """Return figures and curves of every choice."""
    scores: dict[Choice, WalkScore] = {}
    curves = []
    for detector in detectors:
        judged: dict[str, StanceBlock] = {}
        for gate in gates:
            seen(f"{detector}, gate {gate}")
            choice = Choice(detector, gate)
            one = trial(walk, with_choice(params, choice), two_passes=gate == OFFLINE)
            scores[choice], judged[gate] = one.score, one.judged
        curves.append(detector_curves(detector, judged))
        start_ns = int(judged[gates[0]].imu.stamp_ns[0])
    return DetectorStudy(walk.name, scores, curves, true_speed(walk.truth, start_ns))


def with_choice(params: Params, choice: Choice) -> Params:
    """Return the parameters with that detector and that gate."""
    return with_time_gate(changed(params, "stance", detector=choice.detector), choice.gate)
