"""The figures of compared methods of orientation as tables for people, and as plain values for machines."""

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from pdr_core.evaluation.detector_tables import TextTable, metres_text, without_empty
from pdr_core.evaluation.orientation_study import GaitErrors, OrientationStudy
from pdr_core.evaluation.result import plain
from pdr_core.evaluation.walk_score import WalkScore

FIGURE_HEADS = ("recording", "method", "strides", "ATE2 m", "ATE3 m", "at strides m", "closure 2-D m", "closure 3-D m")
GAIT_HEADS = (
    *("recording", "method", "strides", "false", "lengths", "mean cm", "mean %", "sd cm", "sd %"),
    *("pitch offset deg", "pitch RMSE deg"),
)


def figures(studies: Sequence[OrientationStudy]) -> TextTable:
    """Return a row for each recording and method: how far off its track is."""
    rows = [(s.recording, method, *score_text(one)) for s in studies for method, one in s.scores.items()]
    return without_empty(TextTable(FIGURE_HEADS, rows, 2))


def gait(studies: Sequence[OrientationStudy]) -> TextTable:
    """Return a row for each recording and method where heel and toe are known."""
    rows = [(s.recording, method, *gait_text(one)) for s in studies for method, one in s.gait.items()]
    return TextTable(GAIT_HEADS, rows, 2)


def left_out(studies: Sequence[OrientationStudy]) -> Iterator[str]:
    """Yield a sentence for each method that cannot run on a recording."""
    for s in studies:
        yield from (f"{s.recording}, {method}: {why}." for method, why in s.left_out.items())


def score_text(s: WalkScore) -> tuple[str, ...]:
    """Return the figures of one track."""
    strides = str(s.strides) if s.strides_true is None else f"{s.strides} of {s.strides_true}"
    return strides, *map(metres_text, (s.ate2_m, s.ate3_m, s.stride_ate2_m, s.closure_2d_m, s.closure_3d_m))


def gait_text(g: GaitErrors) -> tuple[str, ...]:
    """Return strides and pitch of one method."""
    counts = (f"{g.strides_found} of {g.strides_true}", str(g.strides_false), str(len(g.length_error_m)))
    lengths = (100.0 * g.mean_m, g.mean_percent, 100.0 * g.sd_m, g.sd_percent)
    angles = np.degrees([g.pitch_offset_rad, g.pitch_rmse_rad]).tolist()
    return *counts, *(f"{x:.2f}" if math.isfinite(x) else "" for x in (*lengths, *angles))


def as_json(studies: Sequence[OrientationStudy]) -> str:
    """Return all figures as one JSON object, null for what is unknown."""
    return json.dumps(plain([record(s) for s in studies]), indent=2, allow_nan=False, ensure_ascii=False)


def record(s: OrientationStudy) -> dict[str, Any]:
    """Return the figures of one recording as a mapping."""
    against = {method: gait_record(g) for method, g in s.gait.items()}
    scores = {method: asdict(one) for method, one in s.scores.items()}
    return {"recording": s.recording, "scores": scores, "left_out": s.left_out, "gait": against}


def gait_record(g: GaitErrors) -> dict[str, Any]:
    """Return strides and pitch of one method as a mapping."""
    means = {"mean_m": g.mean_m, "sd_m": g.sd_m, "mean_percent": g.mean_percent, "sd_percent": g.sd_percent}
    return asdict(g) | {"length_error_m": g.length_error_m.tolist(), "length_true_m": g.length_true_m.tolist()} | means
