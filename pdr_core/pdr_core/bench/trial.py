"""One recording through the chain with given parameters, and what became of it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from pdr_core.evaluation.score import Scorer
from pdr_core.evaluation.walk_score import WalkScore, walk_score
from pdr_core.evaluation.words import nothing_usable
from pdr_core.params import Params
from pdr_core.pipeline import ConstrainedFoot, FootInertial, FootOutput, stance_phases
from pdr_core.records import ImuBlock, StanceBlock, StepEvent, Truth, joined, length


@dataclass(frozen=True)
class Walk:
    """The samples of one sensor, in pieces, and what is known of where it was."""

    name: str
    pieces: Sequence[ImuBlock]
    truth: Truth | None


@dataclass(frozen=True)
class Trial:
    """Verdicts and figures; the track is not kept."""

    judged: StanceBlock
    score: WalkScore


class NoSamples(Exception):  # noqa: N818  (what a person meets)
    """A recording with nothing to judge; the text says why."""


def trial(walk: Walk, params: Params, two_passes: bool = False) -> Trial:
    """Run the whole chain over a recording; `two_passes`: its time gate knows all of it. NoSamples of none."""
    phases_s = stance_phases(walk.pieces, params) if two_passes else None
    chain, scorer = ConstrainedFoot(params, phases_s), Scorer(walk.truth)
    judged: list[StanceBlock] = []
    steps: list[StepEvent] = []
    for output in outputs(chain, walk.pieces):
        scorer.add(output.nav)
        judged.append(output.judged)
        steps += output.steps
    verdicts = joined(judged)
    if not length(verdicts):
        raise NoSamples(nothing_usable(walk.name, chain.notices))
    return Trial(verdicts, walk_score(scorer, steps, verdicts.stance))


def outputs(chain: FootInertial, pieces: Sequence[ImuBlock]) -> Iterator[FootOutput]:
    """Yield all that the chain gives out."""
    yield from map(chain.run, pieces)
    yield chain.finish()
