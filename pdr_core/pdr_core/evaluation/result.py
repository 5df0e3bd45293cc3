"""What a run gave, for a machine (JSON) and for a person (sentences)."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from pdr_core.evaluation.external import External
from pdr_core.evaluation.gait_totals import GaitTotals
from pdr_core.evaluation.saving import Saving
from pdr_core.evaluation.score import TruthScore
from pdr_core.evaluation.words import counted, duration, metres, share
from pdr_core.records import Floats, Level, Notice, TruthKind

LEVELS = {Level.OK: "note", Level.WARN: "warning", Level.ERROR: "error"}  # as a person says it


class Hindsight(NamedTuple):
    """What a run knew beforehand, with the whole recording at hand."""

    smoothed: bool = False  # every estimate knew the whole recording
    two_passes: bool = False  # a first pass told the time gate all phases


CAUSAL = Hindsight()
CHEST = "chest"  # the pipeline whose steps are those of a body
LIVE = ", live"  # ends the name of a pipeline whose nodes have estimated


@dataclass(frozen=True)
class Result:
    """One sensor's run, with the configuration and the version that made it."""

    recording: str
    format: str
    samples: int
    duration_s: float
    pipeline: str
    smoothed: bool  # see Hindsight
    two_passes: bool
    strides: int  # the number of steps
    distance_m: float  # the sum of the horizontal stride lengths
    end_position_m: Floats  # (3,)
    closure_2d_m: float
    closure_3d_m: float
    gait: GaitTotals | None  # None: no strides
    seconds: float  # that the estimation alone took
    notices: Sequence[Notice]
    config: Mapping[str, Any]
    truth: TruthScore | None
    version: str
    commit: str
    saving: Saving | None = None  # None: the gyro was not switched
    external: External | None = None  # None: nobody else was asked

    @property
    def rate_hz(self) -> float:
        """Mean sample rate; NaN of fewer than two samples."""
        return (self.samples - 1) / self.duration_s if self.duration_s > 0.0 else math.nan

    @property
    def counts(self) -> str:
        """What is counted: a foot makes strides, a body steps."""
        return "step" if self.worn_on == CHEST else "stride"

    @property
    def worn_on(self) -> str:
        """What the sensor follows."""
        return CHEST if self.pipeline.removesuffix(LIVE) == CHEST else "foot"

    def to_mapping(self) -> dict[str, Any]:
        """Return the result as strict JSON knows it: plain types, None for NaN and infinity."""
        names = ["recording", "format", "samples", "duration_s", "rate_hz", "pipeline", "smoothed", "two_passes"]
        names += ["strides", "distance_m", "end_position_m", "closure_2d_m", "closure_3d_m", "seconds"]
        content = {name: getattr(self, name) for name in names}
        content["gait"] = self.gait.to_mapping() if self.gait else None
        content["notices"] = [_notice(notice) for notice in self.notices]
        content["config"] = self.config
        content["truth"] = _truth(self.truth) if self.truth else None
        if self.saving:
            content["energy"] = self.saving.to_mapping()
        if self.external:
            content["external"] = self.external.to_mapping()
        return plain(content | {"version": self.version, "commit": self.commit})

    def to_json(self) -> str:
        """Return the result as JSON text. Raise TypeError if the configuration holds something JSON cannot."""
        return _text(self.to_mapping())


@dataclass(frozen=True)
class SensorsResult:
    """The results of a recording with several inertial sensors."""

    recording: str
    format: str
    sensors: Mapping[str, Result]
    body: Result | None = None  # between two feet

    def to_mapping(self) -> dict[str, Any]:
        """Return the results as strict JSON knows them."""
        sensors = {name: result.to_mapping() for name, result in self.sensors.items()}
        body = {"body": self.body.to_mapping()} if self.body else {}
        return {"recording": self.recording, "format": self.format, "sensors": sensors} | body

    def to_json(self) -> str:
        """Return the results as JSON text. Raise TypeError if a configuration holds something JSON cannot."""
        return _text(self.to_mapping())


def in_words(result: Result | SensorsResult) -> str:
    """Return one to five plain sentences; one line for each of several sensors."""
    if isinstance(result, SensorsResult):
        named = [*result.sensors.items(), *([("body", result.body)] if result.body else [])]
        return "\n".join(f"{name}: {in_words(one)}" for name, one in named)
    if not result.strides:
        return " ".join(
            [f"No {result.counts} was found within {duration(result.duration_s)}.", *_notices(result.notices)]
        )
    walked = f"Walked {metres(result.distance_m)} in {counted(result.strides, result.counts)}"
    how = ", smoothed" if result.smoothed else ""
    sentences = [f"{walked} within {duration(result.duration_s)}{how}.", *_gait(result.gait), *_error(result)]
    sentences += [result.saving.in_words()] if result.saving else []
    sentences += [result.external.in_words()] if result.external else []
    return " ".join([*sentences, *_notices(result.notices)])


def _gait(gait: GaitTotals | None) -> list[str]:
    """Return one sentence on the usual stride, where there are enough to speak of one."""
    if gait is None or not math.isfinite(gait.cadence_per_min.mean):
        return []
    usual = f"{metres(gait.length_m.mean)} long at {gait.cadence_per_min.mean:.0f} steps a minute"
    stairs = [f"{metres(m)} {way}" for m, way in ((gait.climbed_m, "up"), (gait.descended_m, "down")) if m > 0.0]
    return [f"A stride was {usual}" + (f"; stairs went {' and '.join(stairs)}" if stairs else "") + "."]


def _error(result: Result) -> list[str]:
    """Return one or two sentences on how far off the track is, as far as anybody knows."""
    truth, closure = result.truth, metres(result.closure_2d_m)
    if truth is None:
        return [f"The estimate ends {closure} from where it began; the true path is not known."]
    at_end = f"{metres(truth.end_error_m)} ({share(truth.end_error_percent)} of the distance)"
    if truth.kind is TruthKind.CLOSED_LOOP and math.isfinite(truth.end_error_percent):
        return [f"The walk ended where it began, so the estimate is {at_end} off at the end."]
    if not math.isfinite(truth.ate2_m):
        return ["The track could not be compared with the true path."]
    end = f", and {at_end} off at the end" if math.isfinite(truth.end_error_percent) else ""
    sentences = [f"It was on average {metres(truth.ate2_m)} off the true path{end}."]
    if truth.kind is TruthKind.STRIDES and truth.stride_count_true != result.strides:
        sentences.append(f"In truth there were {counted(truth.stride_count_true, 'stride')}.")
    return sentences


def _notices(notices: Sequence[Notice]) -> list[str]:
    """Return one sentence on every error, the earliest first, or else on one warning; and how many more there are."""
    bad = sorted((n for n in notices if n.level is not Level.OK), key=lambda n: (-n.level.value, n.first_stamp_ns))
    told = [n for n in bad if n.level is Level.ERROR] or bad[:1]
    said = [f"{LEVELS[n.level].capitalize()}: {_with_count(n)}" for n in told]
    if len(bad) > len(told):
        said[-1] += f"; {counted(len(bad) - len(told), 'more warning')}"
    return [text if text.endswith("?") else f"{text}." for text in said]


def _with_count(notice: Notice) -> str:
    return notice.text.rstrip(".") + (f" ({notice.count} times)" if notice.count > 1 else "")


def _notice(notice: Notice) -> dict[str, Any]:
    return {"level": notice.level.name, "kind": notice.kind, "text": notice.text, "count": notice.count}


def _truth(score: TruthScore) -> dict[str, Any]:
    names = ["ate2_m", "ate3_m", "end_error_percent"]
    if score.kind is TruthKind.STRIDES:
        names += ["stride_count_true", "stride_ate2_m"]
    return {"kind": score.kind.value} | {name: getattr(score, name) for name in names}


def plain(value: Any) -> Any:
    """Return the value in plain types, None for a float that JSON cannot say."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return plain(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _text(content: dict[str, Any]) -> str:
    return json.dumps(content, indent=2, allow_nan=False, ensure_ascii=False)
