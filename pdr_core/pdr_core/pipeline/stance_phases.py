"""The first of two passes over a recording: how long its stances last, for a time gate that learns from all of them."""

from collections.abc import Iterable

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS
from pdr_core.intake import Ingestion
from pdr_core.parameter import choices_of
from pdr_core.params import Params, StanceParams, changed
from pdr_core.records import Flags, Floats, ImuBlock, Stamps, StanceBlock
from pdr_core.stance import StanceDetection

OFFLINE = "kmeans_offline"  # kmeans, but a first pass over the whole recording has told it the phases
TIME_GATES = (*choices_of(StanceParams, "time_gate"), OFFLINE)


def with_time_gate(params: Params, gate: str) -> Params:
    """Return the parameters with one of TIME_GATES."""
    return changed(params, "stance", time_gate="kmeans" if gate == OFFLINE else gate)


def stance_phases(pieces: Iterable[ImuBlock], params: Params) -> Floats:
    """Return the durations [s] of the stances that the detector finds without a gate, without the first and last."""
    ungated = changed(params, "stance", time_gate="none")
    intake = Ingestion(params.intake)
    stance = StanceDetection(ungated.stance, params.place, params.detectors)
    judged = [columns(stance.run(intake.run(piece))) for piece in pieces]
    judged += [columns(stance.run(intake.finish())), columns(stance.finish())]
    stamp_ns, resting = (np.concatenate(column) for column in zip(*judged, strict=True))
    return durations_s(stamp_ns, resting)[1:-1]


def columns(judged: StanceBlock) -> tuple[Stamps, Flags]:
    """Return what must be kept of every sample of a recording."""
    return judged.imu.stamp_ns, judged.stance


def durations_s(stamp_ns: Stamps, resting: Flags) -> Floats:
    """Return how long each run of resting samples lasts, (n,) [s]; a gap ends it."""
    step_ns = np.diff(stamp_ns)
    whole = (step_ns >= 0) & (step_ns <= GAP_NS)
    goes_on = resting[1:] & resting[:-1] & whole
    begins = np.flatnonzero(resting & ~np.concatenate([[False], goes_on]))
    ends = np.flatnonzero(resting & ~np.concatenate([goes_on, [False]]))
    return (stamp_ns[ends] - stamp_ns[begins]) / NANOSECONDS
