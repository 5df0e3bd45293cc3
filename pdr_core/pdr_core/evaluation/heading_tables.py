"""The figures of heading constraints as tables for people, and as plain values for machines."""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from pdr_core.evaluation.detector_tables import TextTable, metres_text, without_empty
from pdr_core.evaluation.heading_study import HeadingStudy
from pdr_core.evaluation.result import plain

HEADS = ("recording", "distance m", "algorithm", "ATE2 m", "end error m", "positioning error %", "strides", "held")
BENT_HEADS = ("algorithm", "bends", "mean ATE2 m", "of that without", "worst ATE2 m")


def figures(studies: Sequence[HeadingStudy]) -> TextTable:
    """Return Gui Table 3: a row for each recording and variant."""
    rows: list[tuple[str, ...]] = []
    for s in studies:
        for name, one in s.scores.items():
            percent = f"{one.end_error_percent:.2f}" if math.isfinite(one.end_error_percent) else ""
            errors = (metres_text(one.ate2_m), metres_text(one.end_error_m), percent)
            rows.append((s.recording, f"{s.distance_m:.1f}", name, *errors, str(one.strides), str(one.held)))
    return without_empty(TextTable(HEADS, rows, 3))


def means(studies: Sequence[HeadingStudy]) -> TextTable:
    """Return the mean figures of each variant over the recordings whose true path is known."""
    rows: list[tuple[str, ...]] = []
    for name in studies[0].scores:
        known = [s.scores[name] for s in studies if math.isfinite(s.scores[name].ate2_m)]
        if known:
            ate2_m, percent = [k.ate2_m for k in known], [k.end_error_percent for k in known]
            errors = (metres_text(float(np.mean(ate2_m))), metres_text(max(ate2_m)), f"{np.mean(percent):.2f}")
            rows.append((name, str(len(known)), *errors, str(sum(k.held for k in known))))
    heads = ("algorithm", "recordings", "mean ATE2 m", "worst ATE2 m", "positioning error %", "strides held")
    return TextTable(heads, rows, 1)


def bends(studies: Sequence[HeadingStudy]) -> TextTable:
    """Return what the constraints make of bent corridors, over all recordings."""
    bent = [one.ate2_m for s in studies for one in s.bends]
    if not bent:
        return TextTable(BENT_HEADS, [], 1)
    first = float(np.mean([errors[next(iter(errors))] for errors in bent]))
    rows: list[tuple[str, ...]] = []
    for name in bent[0]:
        ate2_m = [errors[name] for errors in bent]
        mean_m = float(np.mean(ate2_m))
        rows.append((name, str(len(bent)), metres_text(mean_m), f"{mean_m / first:.2f}", metres_text(max(ate2_m))))
    return TextTable(BENT_HEADS, rows, 1)


def as_json(studies: Sequence[HeadingStudy]) -> str:
    """Return all figures as one JSON object, null for what is unknown; the tracks are not in it."""
    kept = [{k: v for k, v in asdict(s).items() if k not in ("tracks_m", "truth_m")} for s in studies]
    return json.dumps(plain(kept), indent=2, allow_nan=False, ensure_ascii=False)
