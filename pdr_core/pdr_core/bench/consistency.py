"""Is the filter as uncertain as it says? Seeded walks against the chi-square bounds of NEES and NIS, both of them.

An error e with covariance P has a normalised square (NEES) e' P^-1 e, chi-square with as many degrees of freedom as e
has components where P is true; so has the innovation of each zero-velocity update (NIS). The mean over N runs of one
epoch lies between the 2.5 % and 97.5 % quantiles of chi-square with N times the freedom, divided by N, in 95 % of the
epochs (Bar-Shalom, Li, Kirubarajan, Estimation with applications to tracking and navigation, 2001, section 5.4).
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pdr_core.bench.believed_walk import CONSUMER, RATE_HZ, BelievedWalk, Ground, believed_walk, ground, told
from pdr_core.eskf.configure import settings
from pdr_core.eskf.error_state import ATTITUDE, VELOCITY
from pdr_core.eskf.smoothing import smooth
from pdr_core.eskf.state import fresh_state
from pdr_core.eskf.tape import recorded
from pdr_core.evaluation.metrics import closure_2d_m, path_length_m, percent
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import Flags, Floats, ImuBlock, StanceBlock, joined, length
from pdr_core.stance import StanceDetection

PARTS = {"velocity and tilt": slice(0, 5), "velocity": slice(0, 3), "tilt": slice(3, 5), "yaw": slice(5, 6)}
UPDATE = "zero-velocity update"


@dataclass(frozen=True)
class Campaign:
    """What is run: how many walks, how long, who says where the foot stands, and what the suite is told."""

    name: str
    detector: bool = False  # the default stance detection instead of true verdicts
    trembles: bool = True
    smoothed: bool = False  # what the smoother says, beside the filter's innovations
    params: Params = field(default_factory=told)


CAMPAIGNS = (
    Campaign("true verdicts"),
    Campaign("default detector", detector=True),
    Campaign("default detector, foot perfectly still", detector=True, trembles=False),
    Campaign("true verdicts, smoothed", smoothed=True),
)


@dataclass(frozen=True)
class Spread:
    """One normalised square over all stance epochs."""

    name: str
    freedom: int
    mean: float
    inside: float  # share of epochs between the bounds
    below: float  # too careful
    above: float  # too sure


@dataclass(frozen=True)
class Consistency:
    """What a campaign has shown."""

    name: str
    runs: int
    distance_m: float
    spreads: list[Spread]
    end_error_median_percent: float
    end_error_95_percent: float
    stance_found: float  # share of the true stance samples


class Track(NamedTuple):
    """What the filter said at n samples."""

    position_m: Floats  # (n, 3)
    velocity_mps: Floats  # (n, 3)
    quat_xyzw: Floats  # (n, 4)
    P: Floats  # (n, 6, 6) of velocity and attitude errors
    nis: Floats  # (n,)


def consistency(campaign: Campaign, runs: int, length_m: float, seen: Callable[[str], object] = str) -> Consistency:
    """Run walks of about `length_m` with the seeds 0, 1, 2 ...; `seen` is told how many are done."""
    where, squares, end_errors, found = ground(length_m), [], [], []
    distance_m = path_length_m(where.motion.position_m)
    for done in range(runs):
        walk = believed_walk(where, told().filter, campaign.trembles, done)
        block = judged(campaign, where, walk.imu)
        track = estimated(block, campaign)
        squares.append(normalised_squares(where, walk, track, block.stance))
        end_errors.append(
            percent(closure_2d_m(track.position_m[-1], walk.position_m[-1]), path_length_m(walk.position_m))
        )
        found.append(block.stance[where.motion.stance].mean())
        seen(str(done + 1))
    freedoms = {name: axes.stop - axes.start for name, axes in PARTS.items()} | {UPDATE: 3}
    spreads = [spread(name, n, np.array([one[name] for one in squares])) for name, n in freedoms.items()]
    median, high = np.percentile(end_errors, [50.0, 95.0])
    return Consistency(campaign.name, runs, distance_m, spreads, float(median), float(high), float(np.mean(found)))


def judged(campaign: Campaign, where: Ground, raw: ImuBlock) -> StanceBlock:
    """Return the samples with their verdicts."""
    imu = Ingestion(campaign.params.intake).run(raw)
    if not campaign.detector:
        return truly_judged(imu, where.motion.stance)
    stage = StanceDetection(campaign.params.stance, campaign.params.place)
    return joined([stage.run(imu), stage.finish()])


def truly_judged(imu: ImuBlock, stance: Flags) -> StanceBlock:
    """Return the samples with true verdicts: the rest before the first step shows the mean of its rates, with noise."""
    n, end = len(stance), int(np.argmin(stance))
    rest_rate, rest_sd = np.zeros((n, 3)), np.zeros(n)
    rest_rate[end] = imu.gyro_radps[1:end].mean(axis=0)
    rest_sd[end] = CONSUMER.gyro_noise_density * np.sqrt(RATE_HZ / (end - 1))
    return StanceBlock(imu, stance, np.zeros(n), np.ones(n), np.zeros(n), rest_rate, rest_sd)


def estimated(block: StanceBlock, campaign: Campaign) -> Track:
    """Return what the filter, or the smoother, says of all samples."""
    tape = recorded(block, settings(campaign.params.filter, campaign.params.place), fresh_state())
    nis = tape.states["normalised_innovation"][1:].copy()
    if campaign.smoothed:
        smooth(tape, np.zeros(length(block), np.bool_), heights_stay=False)
    now, errors = tape.states[1:], slice(VELOCITY, ATTITUDE + 3)
    return Track(now["position_m"], now["velocity_mps"], now["quat_xyzw"], now["P"][:, errors, errors], nis)


def normalised_squares(where: Ground, walk: BelievedWalk, track: Track, stance: Flags) -> dict[str, Floats]:
    """Return the normalised squares at the true stance samples, (epochs,) each; NaN where nothing was updated."""
    true = where.motion
    turn = (Rotation.from_quat(true.quat_xyzw) * Rotation.from_quat(track.quat_xyzw).inv()).as_rotvec()
    known = true.stance & (where.stamp_ns > where.stamp_ns[0] + told().filter.alignment_s * 1e9)
    error, P = np.column_stack([walk.velocity_mps - track.velocity_mps, turn])[known], track.P[known]
    squares = {name: nees(error[:, axes], P[:, axes, axes]) for name, axes in PARTS.items()}
    return squares | {UPDATE: np.where(stance, track.nis, np.nan)[known]}


def nees(error: Floats, P: Floats) -> Floats:
    """Return e' P^-1 e, (n,), of errors (n, m) with covariances (n, m, m)."""
    return np.einsum("ni,ni->n", error, np.linalg.solve(P, error[..., None])[..., 0])


def spread(name: str, freedom: int, squares: Floats) -> Spread:
    """Compare normalised squares (runs, epochs) with both bounds; of an epoch count the runs that have a value."""
    counts = np.sum(np.isfinite(squares), axis=0)
    counted = counts > 0
    mean = np.nansum(squares, axis=0)[counted] / counts[counted]
    low, high = (chi2.ppf(q, freedom * counts[counted]) / counts[counted] for q in (0.025, 0.975))
    below, above = float(np.mean(mean < low)), float(np.mean(mean > high))
    return Spread(name, freedom, float(mean.mean()), 1.0 - below - above, below, above)
