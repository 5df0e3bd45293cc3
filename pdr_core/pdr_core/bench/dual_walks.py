"""Paper 004's experiment on simulated feet: a walk with both sensors, each foot alone and both corrected together.

What turns the tracks is what forces do to a gyro (`g_sensitive`): the rest before the walk does not show it, and it is
mirrored between the feet, but for a share of 30 % that each sensor has for itself. The track of each foot begins where
the foot really was, so an error is that of the walk, not of the start.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.conventions import NANOSECONDS
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import BothFeet, FootInertial
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.records import Floats, ImuBlock, NavBlock, Stamps, StepEvent, joined, length, part
from pdr_core.simulation import SimulatedWalk, simulated_feet

STRAIGHT_M, REPETITIONS = 76.0, 20  # section 4
SENSOR, INDEPENDENT = "g_sensitive", 0.3
EVERY_S = 0.5  # of a track that is kept
PIECE = 500  # samples


@dataclass(frozen=True)
class DualTrial:
    """One walk with both feet."""

    walk: str
    length_m: float
    errors: str  # "mirrored", or "alike" for the control
    seed: int

    @property
    def name(self) -> str:
        """Which walk it is."""
        return f"{self.walk}, {self.length_m:.0f} m"

    @property
    def simulation(self) -> SimulationParams:
        """The walk and its sensors."""
        return SimulationParams(
            walk=self.walk,
            walk_length_m=self.length_m,
            sensor_model=SENSOR,
            feet_errors=self.errors,
            feet_independent=INDEPENDENT,
            seed=self.seed,
        )


class Estimated(NamedTuple):
    """What the chain makes of one foot."""

    nav: NavBlock
    steps: list[StepEvent]


class FootTrack(NamedTuple):
    """Where a foot was said to be and where it was, every half second, and by how much its strides were turned."""

    position_m: Floats  # (n, 2)
    truth_m: Floats  # (n, 2)
    stride_s: Floats  # (strides,) end of each since the start
    heading_error_rad: Floats  # (strides,) of the displacement, counter-clockwise

    @property
    def end_error_m(self) -> Floats:
        """By how much the end is off, (2,)."""
        return self.position_m[-1] - self.truth_m[-1]


class DualWalk(NamedTuple):
    """One walk: the tracks of both feet, each alone and corrected together."""

    trial: DualTrial
    alone: Mapping[str, FootTrack]
    together: Mapping[str, FootTrack]


def dual_walk(trial: DualTrial, params: Params | None = None) -> DualWalk:
    """Simulate a walk and track both feet both ways."""
    walks = simulated_feet(trial.simulation)
    told = params or Params()
    return DualWalk(trial, tracks(walks, each_alone(walks, told)), tracks(walks, both_together(walks, told)))


def each_alone(walks: Mapping[str, SimulatedWalk], params: Params) -> dict[str, Estimated]:
    """Return what each foot makes of its own samples."""
    found = {}
    for name, walk in walks.items():
        chain = FootInertial(params)
        found[name] = estimated([chain.run(walk.imu), chain.finish()])
    return found


def both_together(walks: Mapping[str, SimulatedWalk], params: Params) -> dict[str, Estimated]:
    """Return what each foot makes of its samples and of what the other one tells it."""
    both = BothFeet(params, tuple(walks))
    outputs = [both.run(name, piece) for name, piece in in_turn(walks)] + [both.finish()]
    pieces = [piece for output in outputs for piece in output.feet]
    return {name: estimated([output for foot, output in pieces if foot == name]) for name in walks}


def in_turn(walks: Mapping[str, SimulatedWalk]) -> Iterator[tuple[str, ImuBlock]]:
    """Yield the samples of the feet in turn, so that neither waits long for the other."""
    for start in range(0, max(length(walk.imu) for walk in walks.values()), PIECE):
        yield from ((name, part(walk.imu, start, start + PIECE)) for name, walk in walks.items())


def estimated(outputs: Sequence[FootOutput]) -> Estimated:
    """Return all that became known of one foot."""
    return Estimated(joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps])


def tracks(walks: Mapping[str, SimulatedWalk], estimated: Mapping[str, Estimated]) -> dict[str, FootTrack]:
    """Return each foot's track beside its truth."""
    return {name: track(walks[name], estimated[name]) for name in walks}


def track(walk: SimulatedWalk, estimated: Estimated) -> FootTrack:
    """Return a foot's track in the frame of its truth: from where the foot stood, as it stood there."""
    first_m, start_ns = walk.motion.position_m[0], int(walk.imu.stamp_ns[0])
    turned = Rotation.from_euler("z", yaw_rad(walk.motion.quat_xyzw[0]))
    seconds = np.arange(start_ns, walk.imu.stamp_ns[-1], round(EVERY_S * NANOSECONDS), dtype=np.int64)
    at_ns = np.append(seconds, walk.imu.stamp_ns[-1])
    position_m = first_m + turned.apply(between(at_ns, estimated.nav.stamp_ns, estimated.nav.position_m))
    true_m = between(at_ns, walk.truth.stamp_ns, walk.truth.position_m)
    ends_ns = np.array([(s.start_ns, s.stamp_ns) for s in estimated.steps]).reshape(-1, 2)
    moved = turned.apply(np.array([s.displacement_m for s in estimated.steps]).reshape(-1, 3))
    true_ends_m = between(ends_ns.ravel(), walk.truth.stamp_ns, walk.truth.position_m).reshape(-1, 2, 3)
    error_rad = headings_rad(moved) - headings_rad(true_ends_m[:, 1] - true_ends_m[:, 0])
    stride_s = (ends_ns[:, 1] - start_ns) / NANOSECONDS
    return FootTrack(position_m[:, :2], true_m[:, :2], stride_s, wrapped(error_rad))


def between(wanted_ns: Stamps, stamp_ns: Stamps, position_m: Floats) -> Floats:
    """Return positions (m, 3) at wanted stamps (m,) from those at ascending stamps, (n,) and (n, 3), linearly."""
    wanted, known = ((stamps - stamp_ns[0]).astype(np.float64) for stamps in (wanted_ns, stamp_ns))
    return np.column_stack([np.interp(wanted, known, axis_m) for axis_m in position_m.T])


def headings_rad(moved_m: Floats) -> Floats:
    """Return the directions of displacements (n, 3), counter-clockwise from x, (n,)."""
    return np.arctan2(moved_m[:, 1], moved_m[:, 0])


def wrapped(angle_rad: Floats) -> Floats:
    """Return the same angles within -pi .. pi."""
    return (angle_rad + np.pi) % (2.0 * np.pi) - np.pi
