"""Gui Table 3 on recordings: zero velocity alone, with what rests tell of the gyro bias, and with each constraint.

The magnetometer is left out, since it would hold the heading too.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from pdr_core.bench.bends import Bendable
from pdr_core.bench.trial import NoSamples, Walk, outputs
from pdr_core.evaluation import alignment
from pdr_core.evaluation.heading_study import BentScore, HeadingScore, HeadingStudy
from pdr_core.evaluation.metrics import stride_distance_m
from pdr_core.evaluation.score import Scorer, TruthScore, TruthView, start_of_steps_m
from pdr_core.evaluation.words import nothing_usable
from pdr_core.params import Params, changed
from pdr_core.pipeline import ConstrainedFoot
from pdr_core.records import Floats, TruthKind

NEVER_S = 60.0  # longer than any window of a rest
WITHOUT = "with ZARU in later rests"  # what the constraints are added to
PARTS: dict[str, Mapping[str, Mapping[str, Any]]] = {
    "ZUPT alone": {"filter": {"initial_gyro_bias_sd_radps": 1e-9}},
    "with the bias of the first rest": {"stance": {"rest_later_s": NEVER_S}},
    WITHOUT: {},
}
CONSTRAINTS = ("dominant", "hde", "ihde", "learned")
ANGLES_DEG = (-12.0, -10.0, -8.0, 8.0, 10.0, 12.0)
MOST = 8  # bends of one recording, spread over its corridors


class Tracked(NamedTuple):
    """What a setting made of a walk."""

    score: HeadingScore
    distance_m: float
    view: TruthView | None
    position_m: Floats  # (n, 2) of the ends of the stances


def variants(params: Params, constraints: Sequence[str]) -> dict[str, Params]:
    """Return the rows of the table."""
    base = changed(params, "filter", magnetometer="off")
    rows = {name: changed_by(changed(base, "heading", constraint="none"), part) for name, part in PARTS.items()}
    return rows | {name: changed(base, "heading", constraint=name) for name in constraints}


def changed_by(params: Params, part: Mapping[str, Mapping[str, Any]]) -> Params:
    """Return the parameters with values of several groups changed."""
    for group, values in part.items():
        params = changed(params, group, **values)
    return params


def study(
    walk: Walk, params: Params, constraints: Sequence[str] = CONSTRAINTS, seen: Callable[[str], object] = str
) -> HeadingStudy:
    """Return the figures of a recording by every variant; `seen` is told which. NoSamples of an empty one."""
    rows, found = variants(params, constraints), {}
    for name, row in rows.items():
        seen(name)
        found[name] = tracked(walk, row)
    return HeadingStudy(
        walk.name,
        found[WITHOUT].distance_m,
        {name: one.score for name, one in found.items()},
        list(bends(walk, {name: rows[name] for name in (WITHOUT, *constraints)}, seen)),
        *over_one_truth(found),
    )


def tracked(walk: Walk, params: Params) -> Tracked:
    """Run the chain over a recording."""
    chain, scorer, steps = ConstrainedFoot(params), Scorer(walk.truth), []
    for output in outputs(chain, walk.pieces):
        scorer.add(output.nav)
        steps += output.steps
    if not np.isfinite(scorer.end_position_m).all():
        raise NoSamples(nothing_usable(walk.name, chain.notices))
    start_m = start_of_steps_m(steps, scorer.start_position_m)
    known = scorer.score(steps, start_m) or TruthScore(TruthKind.CLOSED_LOOP)
    held = sum(notice.count for notice in chain.notices if notice.kind == "heading_held")
    score = HeadingScore(known.ate2_m, known.end_error_m, known.end_error_percent, len(steps), held)
    footfalls_m = np.array([start_m, *(step.position_m for step in steps)])[:, :2]
    return Tracked(score, stride_distance_m(steps), scorer.view(steps, start_m), footfalls_m)


def over_one_truth(found: Mapping[str, Tracked]) -> tuple[dict[str, Floats], Floats | None]:
    """Return the tracks, (n, 2), laid onto the truth as the first variant sees it, and that; else from their start."""
    truth = next((one.view.truth_m for one in found.values() if one.view), None)
    if truth is None:
        return {name: one.position_m for name, one in found.items()}, None
    tracks = {}
    for name, one in found.items():
        view = one.view
        if view:
            known = np.isfinite(view.truth_m).all(axis=1)
            laid = alignment.over_whole(view.truth_m[known], truth[known])
            tracks[name] = laid.apply(view.estimate_m)[:, :2]
    return tracks, truth[:, :2]


def bends(walk: Walk, rows: Mapping[str, Params], seen: Callable[[str], object] = str) -> Iterator[BentScore]:
    """Yield what each of some settings makes of the walk with bends in its corridors."""
    if walk.truth is None or walk.truth.kind is not TruthKind.STRIDES:
        return
    bendable = Bendable(walk, walk.truth, rows[WITHOUT])
    strides = bendable.corridors
    for i in np.unique(np.linspace(0, len(strides) - 1, MOST).round().astype(int)) if strides else []:
        for angle_deg in ANGLES_DEG:
            seen(f"stride {strides[i] + 1} bent by {angle_deg:g} deg")
            bent = bendable.bent(strides[i], float(np.radians(angle_deg)))
            errors = {name: tracked(bent, row).score.ate2_m for name, row in rows.items()}
            yield BentScore(strides[i] + 1, angle_deg, errors)
