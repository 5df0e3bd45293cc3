"""What each part of the method is worth: every part switched off by its parameter, one at a time."""

from collections.abc import Callable, Mapping
from typing import Any

from pdr_core.bench.trial import Walk, trial
from pdr_core.evaluation.walk_score import WalkScore
from pdr_core.params import Params, changed

FULL = "nothing"
PLAIN = "all of these, fixed at 2000"
OFF: dict[str, Mapping[str, Mapping[str, Any]]] = {
    FULL: {},
    "relative threshold: fixed at 30": {"stance": {"relative_share": 0.0}},
    "relative threshold: fixed at 2000": {"stance": {"relative_share": 0.0, "threshold_min": 2000.0}},
    "noise of the sensor": {"stance": {"quiet_max": 0.0}},
    "confidence": {"stance": {"sd_per_root_mps": 0.0}},
    "rolling contact": {"filter": {"contact_height_m": 0.0}},
    "Huber's weight": {"filter": {"huber": 1e9}},
    "contradiction": {"filter": {"gate": 1e9}},
    "noise of change": {"intake": {"change_noise": 0.0}},
    "clip repair": {"intake": {"clip_smallest_radps": 1e6}},
    "gyro bias: taken as 0": {"filter": {"initial_gyro_bias_sd_radps": 1e-9}},
    PLAIN: {
        "stance": {"relative_share": 0.0, "threshold_min": 2000.0, "quiet_max": 0.0, "sd_per_root_mps": 0.0},
        "filter": {"contact_height_m": 0.0, "huber": 1e9, "gate": 1e9, "initial_gyro_bias_sd_radps": 1e-9},
        "intake": {"change_noise": 0.0, "clip_smallest_radps": 1e6},
    },
}


def without(params: Params, part: str) -> Params:
    """Return the parameters with a part of OFF switched off."""
    for group, values in OFF[part].items():
        params = changed(params, group, **values)
    return params


def ablation(walk: Walk, params: Params, seen: Callable[[str], object] = str) -> dict[str, WalkScore]:
    """Return the figures of one recording without each part; `seen` is told which is off."""
    scores = {}
    for part in OFF:
        seen(f"without {part}")
        scores[part] = trial(walk, without(params, part)).score
    return scores
