"""A walk whose person somebody else follows: the track with their fixes beside that without, and what trouble does.

The sensor sits on the left shoe, the source follows the body midway between both feet: two things that differ by half a
stride along and a hand's breadth across. An error is that of the foot in the frame of the source: its true place there
beside what the track and the frame that was found say of it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from pdr_core.bench.dual_walks import between
from pdr_core.conventions import NANOSECONDS, nanoseconds
from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline.aided_foot import AidedFoot
from pdr_core.records import Floats, ImuBlock, NavBlock, Notice, Stamps, joined, length, part
from pdr_core.records_external import ExternalFrame, FixBlock, about_up
from pdr_core.simulation import SimulatedWalk, simulated_feet
from pdr_core.simulation.external_source import ExternalSource, fixes, midway

LENGTH_M, WALK, SENSOR = 600.0, "corridor", "consumer"
PIECE = 50  # samples
ARRIVES_S = 0.1  # a fix comes so long after it was measured
EVERY_S = 0.5
SPEED_MPS = 1.25
TROUBLE_S = 60.0
GOOD = "good"


@dataclass(frozen=True)
class ExternalTrial:
    """One walk and one source."""

    name: str
    source: ExternalSource = field(default_factory=ExternalSource)
    seed: int = 0
    length_m: float = LENGTH_M
    walk: str = WALK

    @property
    def simulation(self) -> SimulationParams:
        """The walk and its sensors."""
        return SimulationParams(
            walk=self.walk, walk_length_m=self.length_m, sensor_model=SENSOR, motion="smooth", seed=self.seed
        )


class AidedTrack(NamedTuple):
    """What was made of one walk, every half second."""

    time_s: Floats  # (n,) since the start
    ours_m: Floats  # (n, 2) in our frame
    theirs_m: Floats  # (n, 2) in their frame; NaN without one
    truth_m: Floats  # (n, 2) in their frame
    covariance_m2: Floats  # (n, 2, 2) of the filter, in their frame
    frame: ExternalFrame | None
    notices: list[Notice]
    aligned_s: float  # NaN: never

    @property
    def error_m(self) -> Floats:
        """By how much the place is off, (n,), once the frames are aligned."""
        error_m = np.linalg.norm(self.theirs_m - self.truth_m, axis=1)
        return np.where(self.time_s >= self.aligned_s + 1.0, error_m, np.nan)


def external_walk(trial: ExternalTrial, params: Params | None = None) -> AidedTrack:
    """Simulate a walk and a source, and track the left foot with it."""
    walks = simulated_feet(trial.simulation)
    said = fixes(midway(walks["left"].truth, walks["right"].truth), trial.source, trial.seed)
    return aided_track(walks["left"], said, trial.source, params or Params())


def unaided(trial: ExternalTrial, frame: ExternalFrame | None, params: Params | None = None) -> AidedTrack:
    """Track the same walk without the source, and lay it into their frame by one that was found."""
    walk = simulated_feet(trial.simulation)["left"]
    alone = aided_track(walk, None, trial.source, params or Params())
    return in_their_frame(alone, frame)


def aided_track(walk: SimulatedWalk, said: FixBlock | None, source: ExternalSource, params: Params) -> AidedTrack:
    """Return the track of a foot with what was said, if anything."""
    foot, outputs = AidedFoot(params), []
    for piece, come in in_turn(walk, said, source.clock_s):
        outputs.append(foot.run(piece))
        if come:
            foot.fixes(come)
    outputs.append(foot.finish())
    nav = joined([output.nav for output in outputs])
    start_ns = int(walk.imu.stamp_ns[0])
    at_ns = np.arange(start_ns, nav.stamp_ns[-1], nanoseconds(EVERY_S), dtype=np.int64)
    found = [n.first_stamp_ns for n in foot.notices if n.kind == "external_aligned"]
    track = AidedTrack(
        (at_ns - start_ns) / NANOSECONDS,
        between(at_ns, nav.stamp_ns, nav.position_m)[:, :2],
        np.full((len(at_ns), 2), np.nan),
        truth_m(walk, at_ns, source),
        covariances_m2(nav, at_ns),
        None,
        foot.notices,
        (found[0] - start_ns) / NANOSECONDS if found else np.nan,
    )
    return in_their_frame(track, foot.frame)


def in_their_frame(track: AidedTrack, frame: ExternalFrame | None) -> AidedTrack:
    """Return a track laid into their frame."""
    if frame is None:
        return track
    R = about_up(frame.yaw_rad)[:2, :2]
    theirs_m = track.ours_m @ R.T + frame.shift_m[:2]
    aligned_s = 0.0 if np.isnan(track.aligned_s) else track.aligned_s
    return track._replace(
        theirs_m=theirs_m, covariance_m2=R @ track.covariance_m2 @ R.T, frame=frame, aligned_s=aligned_s
    )


def in_turn(walk: SimulatedWalk, said: FixBlock | None, clock_s: float) -> Iterator[tuple[ImuBlock, FixBlock | None]]:
    """Yield pieces of the samples, each with the fixes that come with it or None."""
    done, arrives_ns = 0, nanoseconds(ARRIVES_S - clock_s)
    for start in range(0, length(walk.imu), PIECE):
        piece = part(walk.imu, start, start + PIECE)
        if said is None:
            yield piece, None
            continue
        reached = int(np.searchsorted(said.stamp_ns + arrives_ns, piece.stamp_ns[-1], side="right"))
        yield piece, part(said, done, reached) if reached > done else None
        done = reached


def truth_m(walk: SimulatedWalk, at_ns: Stamps, source: ExternalSource) -> Floats:
    """Return where the foot really was, in their frame, (n, 2)."""
    ours_m = between(at_ns, walk.truth.stamp_ns, walk.truth.position_m)
    return (ours_m @ about_up(source.yaw_rad).T + np.array(source.shift_m))[:, :2]


def covariances_m2(nav: NavBlock, at_ns: Stamps) -> Floats:
    """Return the filter's covariances of the place at stamps, (n, 2, 2)."""
    rows = np.clip(np.searchsorted(nav.stamp_ns, at_ns), 0, length(nav) - 1)
    return nav.pose_covariance[rows][:, :2, :2]


def moved_m(track: AidedTrack, other: AidedTrack) -> Floats:
    """Return by how much two tracks of one walk differ, (n,), in our frame."""
    return np.linalg.norm(track.ours_m - other.ours_m, axis=1)


def trials(seed: int, length_m: float = LENGTH_M) -> list[ExternalTrial]:
    """Return a good source, and one with each trouble from the middle of the walk on."""
    good, begin_s = ExternalSource(), 0.5 * length_m / SPEED_MPS
    end_s = begin_s + TROUBLE_S
    troubles = {
        GOOD: good,
        "outliers of 100 m": replace(good, outliers_s=tuple(begin_s + np.arange(6) * 10.0)),
        "drifts away at 0.1 m/s": replace(good, drifts=(begin_s, np.inf)),
        "drifts for 60 s, is right again": replace(good, drifts=(begin_s, end_s), back_s=end_s),
        "silent for 60 s": replace(good, silent=((begin_s, end_s),)),
        "frozen for 60 s": replace(good, frozen=((begin_s, end_s),)),
    }
    return [ExternalTrial(name, source, seed, length_m) for name, source in troubles.items()]


def silenced(trial: ExternalTrial) -> ExternalTrial:
    """Return the trial with a source that says nothing in place of what is wrong."""
    s = trial.source
    wrong = [(at_s, at_s + 1.0 / s.rate_hz) for at_s in s.outliers_s] + [*s.frozen, *s.silent]
    wrong += [(s.drifts[0], s.back_s)] if np.isfinite(s.drifts[0]) else []
    clean = replace(s, outliers_s=(), frozen=(), drifts=(np.inf, np.inf), back_s=np.inf, silent=tuple(wrong))
    return replace(trial, source=clean)
