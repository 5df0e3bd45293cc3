"""The figures of compared detectors as tables for people, and as plain values for machines."""

import csv
import io
import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, NamedTuple

from pdr_core.evaluation.detector_study import Choice, DetectorStudy
from pdr_core.evaluation.result import plain
from pdr_core.evaluation.walk_score import FAILED_M, Summary, WalkScore, summary

FIGURE_HEADS = (
    *("recording", "detector", "gate", "strides", "ATE2 m", "ATE3 m", "at strides m"),
    *("closure 2-D m", "closure 3-D m", "stance %"),
)
SUMMARY_HEADS = ("walks", "mean m", "median m", "worst m", f"over {FAILED_M:g} m", "strides wrong")
LOOP_HEADS = ("loops", "closure 2-D m", "closure 3-D m")


class TextTable(NamedTuple):
    """Text in columns; the first ones name what the numbers are of."""

    heads: tuple[str, ...]
    rows: list[tuple[str, ...]]
    names: int  # columns of names, to the left


def figures(studies: Sequence[DetectorStudy]) -> TextTable:
    """Return a row for each recording and choice; one recording needs no name."""
    named = len(studies) > 1
    rows = [
        (s.recording * named, *choice_text(c), *score_text(score)) for s in studies for c, score in s.scores.items()
    ]
    return without_empty(TextTable(FIGURE_HEADS, rows, 3))


def summaries(studies: Sequence[DetectorStudy]) -> TextTable:
    """Return a row for each choice over all recordings whose truth is known."""
    rows = [(*choice_text(c), *summary_text(one)) for c, one in by_choice(studies).items()]
    return without_empty(TextTable(("detector", "gate", *SUMMARY_HEADS, *LOOP_HEADS), rows, 2))


def worth(studies: Sequence[DetectorStudy]) -> TextTable:
    """Return a row for each part that was switched off."""
    rows = [(part, *summary_text(one)) for part, one in by_part(studies).items()]
    return without_empty(TextTable(("switched off", *SUMMARY_HEADS, *LOOP_HEADS), rows, 1))


def by_choice(studies: Sequence[DetectorStudy]) -> dict[Choice, Summary]:
    """Return each choice over all recordings."""
    return {choice: summary([s.scores[choice] for s in studies]) for choice in (studies[0].scores if studies else ())}


def by_part(studies: Sequence[DetectorStudy]) -> dict[str, Summary]:
    """Return the method without each part over all recordings on which that was tried."""
    tried = [s.ablation for s in studies if s.ablation]
    return {part: summary([scores[part] for scores in tried]) for part in (tried[0] if tried else ())}


def as_json(studies: Sequence[DetectorStudy]) -> str:
    """Return everything but the curves as one JSON object, null for what is unknown."""
    windows = [{"recording": s.recording, **s.windows._asdict()} for s in studies if s.windows]
    content = {
        "figures": records(studies),
        "summary": [c._asdict() | asdict(one) for c, one in by_choice(studies).items()],
        "windows": windows,
        "ablation": [{"switched_off": part} | asdict(one) for part, one in by_part(studies).items()],
    }
    return json.dumps(plain(content), indent=2, allow_nan=False, ensure_ascii=False)


def as_csv(studies: Sequence[DetectorStudy]) -> str:
    """Return a line for each recording and choice, empty fields for what is unknown."""
    rows, text = [plain(record) for record in records(studies)], io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]) if rows else [], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def records(studies: Sequence[DetectorStudy]) -> list[dict[str, Any]]:
    """Return a flat mapping for each recording and choice."""
    return [
        {"recording": s.recording, **c._asdict(), **asdict(score)} for s in studies for c, score in s.scores.items()
    ]


def choice_text(choice: Choice) -> tuple[str, str]:
    """Return detector and gate as they are typed; an empty gate where there is none."""
    return choice.detector, "" if choice.gate == "none" else choice.gate


def score_text(s: WalkScore) -> tuple[str, ...]:
    """Return the figures of one recording."""
    strides = str(s.strides) if s.strides_true is None else f"{s.strides} of {s.strides_true}"
    errors = (s.ate2_m, s.ate3_m, s.stride_ate2_m, s.closure_2d_m, s.closure_3d_m)
    return strides, *map(metres_text, errors), f"{100.0 * s.stance_share:.0f}"


def summary_text(s: Summary) -> tuple[str, ...]:
    """Return the figures of many recordings."""
    walks = (str(s.recordings), *map(metres_text, (s.mean_m, s.median_m, s.worst_m)), str(s.failed))
    loops = (str(s.loops), *map(metres_text, (s.closure_2d_m, s.closure_3d_m)))
    strides = str(s.strides_wrong) if s.counted else ""
    return (*(walks if s.recordings else ("",) * 5), strides, *(loops if s.loops else ("",) * 3))


def metres_text(length_m: float) -> str:
    """Return a length to the millimetre, or nothing where it is not known."""
    return f"{length_m:.3f}" if math.isfinite(length_m) else ""


def without_empty(table: TextTable) -> TextTable:
    """Return the table without the columns in which nothing stands, and without rows if only names are left."""
    keep = [i for i in range(len(table.heads)) if any(row[i] for row in table.rows)]
    heads = tuple(table.heads[i] for i in keep)
    names = sum(i < table.names for i in keep)
    rows = [tuple(row[i] for i in keep) for row in table.rows] if names < len(keep) else []
    return TextTable(heads, rows, names)
