"""Every method of orientation on one recording, through the same intake, the same verdicts and the same de-drift.

The error-state filter has a position of its own; the others get theirs by `pipeline/filter_free.py`.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from pdr_core.bench.orientations import ORIENTATIONS, CannotOrient
from pdr_core.bench.trial import NoSamples, Walk
from pdr_core.conventions import seconds_between
from pdr_core.eskf import ZuptFilter
from pdr_core.evaluation.mocap_gait import gait_errors, markers, pitch_cycle
from pdr_core.evaluation.orientation_study import Drift, OrientationStudy
from pdr_core.evaluation.score import Scorer
from pdr_core.evaluation.walk_score import WalkScore, walk_score
from pdr_core.evaluation.words import nothing_usable
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.pipeline.filter_free import FilterFree, known_orientation
from pdr_core.records import Floats, NavBlock, StanceBlock, StepEvent, joined, length
from pdr_core.stance import StanceDetection
from pdr_core.strapdown.swing import Track

OWN_POSITION = "error_state"


class Tracked(NamedTuple):
    """What one method made of a walk."""

    nav: NavBlock
    steps: list[StepEvent]
    track: Track | None  # of the method without a filter


def study(walk: Walk, params: Params, methods: Sequence[str], seen: Callable[[str], object] = str) -> OrientationStudy:
    """Run the methods over a recording; `seen` is told which. NoSamples if it holds no usable sample."""
    judged = verdicts(walk, params)
    tracks: dict[str, Tracked] = {}
    left_out: dict[str, str] = {}
    for method in methods:
        seen(method)
        try:
            tracks[method] = tracked(method, judged, params)
        except CannotOrient as why:
            left_out[method] = str(why)
    scores = {method: score(walk, one, judged) for method, one in tracks.items()}
    drift = next((drift_of(one) for one in tracks.values() if one.track), None)
    found = markers(walk.truth)
    if found is None:
        return OrientationStudy(walk.name, scores, left_out, drift=drift)
    gait = {m: gait_errors(found, one.nav.stamp_ns, one.nav.quat_xyzw, one.steps) for m, one in tracks.items()}
    quaternions = {method: one.nav.quat_xyzw for method, one in tracks.items()}
    cycle = pitch_cycle(found, judged.imu.stamp_ns, quaternions)
    return OrientationStudy(walk.name, scores, left_out, gait, cycle, drift)


def verdicts(walk: Walk, params: Params) -> StanceBlock:
    """Return the samples of a walk as they reach the methods."""
    intake, stance = Ingestion(params.intake), StanceDetection(params.stance, params.place, params.detectors)
    pieces = [stance.run(intake.run(piece)) for piece in walk.pieces]
    judged = joined([*pieces, stance.run(intake.finish()), stance.finish()])
    if not length(judged):
        raise NoSamples(nothing_usable(walk.name, intake.notices))
    return judged


def tracked(method: str, judged: StanceBlock, params: Params) -> Tracked:
    """Run one method; CannotOrient if it cannot be run."""
    if method == OWN_POSITION:
        own = ZuptFilter(params.filter, params.place)
        nav, steps = own.run(judged)
        return Tracked(nav, steps + own.finish(), None)
    return by_orientation(ORIENTATIONS[method](judged, params), judged, params)


def by_orientation(quat_xyzw: Floats, judged: StanceBlock, params: Params) -> Tracked:
    """Return the track that follows from orientations (n, 4), however they were found."""
    chain = FilterFree(params)
    outputs = [chain.run(judged, known_orientation(judged.imu.stamp_ns, quat_xyzw)), chain.finish()]
    steps = [step for output in outputs for step in output.steps]
    return Tracked(joined([o.nav for o in outputs]), steps, joined([o.track for o in outputs]))


def score(walk: Walk, one: Tracked, judged: StanceBlock) -> WalkScore:
    """Return the figures of a track."""
    scorer = Scorer(walk.truth)
    scorer.add(one.nav)
    return walk_score(scorer, one.steps, judged.stance)


def drift_of(one: Tracked) -> Drift:
    """Return the velocity of a track before and after its drift was taken off, along the way from start to end."""
    assert one.track is not None
    time_s = seconds_between(one.nav.stamp_ns, int(one.nav.stamp_ns[0]))
    return Drift(time_s, one.track.free_mps, np.asarray(one.track.velocity_mps))
