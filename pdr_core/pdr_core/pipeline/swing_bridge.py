"""Fills in the rates of a gyro that its sensor lets sleep while the foot stands, as uncertain as they are.

While the gyro is on all the time, the rule of the switch is followed all the same: so it is known where the gyro would
have slept, and what the foot has turned there (`gait/stance_turns.py`). Later, two turns are laid into each sleep: one
dies away after the heel, one grows before the gyro's first rate; in between the foot stands, and the accelerometer,
which never sleeps, shows which way is up. It is carried on by the rates, for the landing that follows.

Samples wait for the end of the sleep, or for `HELD_NS`: then the foot is taken to stand until it is known to leave.
"""

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS
from pdr_core.gait.missed_turn import Missed
from pdr_core.gait.stance_turns import LAND_NS, LIFT_NS, UNKNOWN, StanceTurns, carried, stand, whole
from pdr_core.maths.motion_switch import MotionRule, MotionSwitch
from pdr_core.maths.quaternion import Four, conjugate, from_rotation_vector, multiply, rows
from pdr_core.maths.runs import equal_runs
from pdr_core.maths.vector import rotated
from pdr_core.records import NO_SAMPLES, Flags, Floats, ImuBlock, Stamps, joined, length, part

HELD_NS = 800_000_000  # a longer sleep is no stance of a walk, and teaches nothing
KEPT_NS = HELD_NS + 2 * GAP_NS
STAND_WALK = 0.01  # rad/sqrt(s) that a standing foot pivots
STEEPEST = 20.0


class SwingBridge:
    """Samples in; the same out with a rate each, later where the gyro sleeps."""

    def __init__(self, rule: MotionRule) -> None:
        self._turns = StanceTurns()
        self._switch = MotionSwitch(rule, powered=True)
        self._known = NO_SAMPLES  # with a rate
        self._awake: Flags = np.zeros(0, np.bool_)  # whether it would be, of these
        self._held = NO_SAMPLES  # asleep
        self._last = NO_SAMPLES  # the last sample with a rate before that
        self._up: Floats | None = None  # (3,) in the axes of the foot there; None: nobody knows
        self._since: Four | None = None  # the turn from the first rate after the last sleep to there
        self._told_ns = 0  # the last sample that was given out
        self.bias_radps: Floats = np.zeros(3)  # of the gyro: what a standing foot would show

    @property
    def ready(self) -> bool:
        """Enough was learnt to let the gyro sleep."""
        return self._turns.ready

    @property
    def share_about_up(self) -> float:
        """The share of the noise of a rate that was filled in which acts about the vertical."""
        return self._turns.share_about_up

    def run(self, imu: ImuBlock) -> ImuBlock:
        """Return the samples whose rates are measured, or are told by now."""
        out = [NO_SAMPLES]
        for run in alike(imu):
            out += self._awake_run(run) if run.gyro_sd_radps[0] >= 0.0 else [self._asleep_run(run)]
        return joined(out)

    def finish(self) -> ImuBlock:
        """Return what still waits: the gyro sleeps on."""
        held, self._held = self._held, NO_SAMPLES
        return self._landed(held, self._unbiased(joined([self._last, held])))

    def _awake_run(self, imu: ImuBlock) -> list[ImuBlock]:
        held, self._held = self._held, NO_SAMPLES
        before = self._lifted(held, imu) if length(held) else NO_SAMPLES
        since = self._unbiased(imu if length(held) else joined([self._last, imu]))
        self._up = carried(self._up, since) if self._up is not None and unbroken(since) else None
        self._since = multiply(self._since, whole(since)) if self._since and unbroken(since) else None
        self._learn(imu)
        self._last, self._told_ns = part(imu, length(imu) - 1), int(imu.stamp_ns[-1])
        return [before, imu]

    def _asleep_run(self, imu: ImuBlock) -> ImuBlock:
        self._known, self._awake = NO_SAMPLES, np.zeros(0, np.bool_)
        held = joined([self._held, imu])
        lasts = not length(self._last) or held.stamp_ns[-1] - self._last.stamp_ns[-1] > HELD_NS
        done = int(np.searchsorted(held.stamp_ns, held.stamp_ns[-1] - LIFT_NS)) if lasts else 0
        self._held = part(held, done)
        return self._landed(part(held, 0, done), self._unbiased(joined([self._last, held])))

    def _landed(self, asleep: ImuBlock, sleep: ImuBlock) -> ImuBlock:
        """Return samples of a foot that comes to its stand, if it has not yet, and stands at their end."""
        n = length(asleep)
        if n == 0 or not length(self._last) or self._told_ns != self._last.stamp_ns[-1]:
            return self._filled(asleep, np.zeros((n, 3)), np.full(n, STAND_WALK))
        told = UNKNOWN
        if self._up is not None:
            told = self._turns.landing(sleep.gyro_radps[0], self._up, stand(sleep, stand(sleep).row))
        return self._turned(asleep, told, self._last, LAND_NS)

    def _lifted(self, held: ImuBlock, then: ImuBlock) -> ImuBlock:
        """Return samples at whose end the foot leaves its stand, with the rate that the gyro finds then."""
        first = part(then, 0, 1)
        sleep = self._unbiased(joined([self._last, held, first]))
        stands = stand(sleep)
        row = stands.row - length(self._last)
        landed = self._landed(part(held, 0, row), sleep)
        told = self._turns.lifting(sleep, stands)
        turn = from_rotation_vector(told.turn_rad)
        self._up = np.array(rotated(rows(conjugate(turn)), stands.up)) if self.ready else None
        return joined([landed, self._turned(part(held, row), told, first, LIFT_NS)])

    def _turned(self, asleep: ImuBlock, told: Missed, edge: ImuBlock, most_ns: int) -> ImuBlock:
        """Return samples that turn as told, up to `most_ns` from a sample with a rate at one end, and stand elsewhere.

        The filter takes trapezia: half of the interval at that end has the gyro's own rate.
        """
        away_ns = np.abs(asleep.stamp_ns - edge.stamp_ns[0])
        longest_ns = max(1, min(most_ns, int(away_ns.max())))
        share = share_per_s(away_ns, longest_ns, told.mean_time_s)
        turn_rad = told.turn_rad - 0.5e-9 * away_ns.min() * (edge.gyro_radps[0] - self.bias_radps)
        rates = share[:, None] * turn_rad / max(float(share @ widths_s(asleep, edge)), 1e-3)
        noise = told.sd_rad / (longest_ns / NANOSECONDS) ** 0.5
        return self._filled(asleep, rates, np.where(away_ns <= longest_ns, noise, STAND_WALK))

    def _filled(self, imu: ImuBlock, rate_radps: Floats, noise: Floats) -> ImuBlock:
        """Return samples with rates (n, 3), and their noise (n,) [rad/sqrt(s)] as a deviation of each sample."""
        if not length(imu):
            return imu
        steps_ns = np.clip(np.diff(imu.stamp_ns, prepend=self._told_ns), 1, GAP_NS)
        self._told_ns = int(imu.stamp_ns[-1])
        sd_radps = noise / np.sqrt(steps_ns / NANOSECONDS)
        return imu._replace(gyro_radps=rate_radps + self.bias_radps, gyro_sd_radps=sd_radps)

    def _learn(self, imu: ImuBlock) -> None:
        """Learn from the sleeps that would have been."""
        _, awake = self._switch.run(imu.stamp_ns, imu.accel_mps2)
        self._known, self._awake = joined([self._known, imu]), np.concatenate([self._awake, awake])
        new = length(self._known) - length(imu)
        for asleep, woke in sleeps(self._awake):
            if woke >= new and asleep > 0:
                self._take(asleep - 1, woke)
        old = int(np.searchsorted(self._known.stamp_ns, self._known.stamp_ns[-1] - KEPT_NS))
        self._known, self._awake = part(self._known, old), self._awake[old:]

    def _take(self, last: int, woke: int) -> None:
        """Learn from the rows from the last one awake to the next one."""
        slept = self._unbiased(part(self._known, last, woke + 1))
        if slept.stamp_ns[-1] - slept.stamp_ns[1] <= HELD_NS and unbroken(slept):
            after = whole(self._unbiased(part(self._known, last)))
            self._turns.learn(slept, multiply(self._since, conjugate(after)) if self._since else None)
            stands = stand(slept)
            self._up = carried(stands.up, self._unbiased(part(self._known, last + stands.row)))
        self._since = whole(self._unbiased(part(self._known, woke)))

    def _unbiased(self, imu: ImuBlock) -> ImuBlock:
        return imu._replace(gyro_radps=imu.gyro_radps - self.bias_radps)


def alike(imu: ImuBlock) -> list[ImuBlock]:
    """Return the samples in runs with a rate, and without."""
    return [part(imu, first, behind) for first, behind in equal_runs(imu.gyro_sd_radps >= 0.0)]


def sleeps(awake: Flags) -> list[tuple[int, int]]:
    """Return of each sleep that is over its first row, and the first row after it."""
    edges = np.flatnonzero(np.diff(awake.astype(np.int8)))
    woke = edges[awake[edges + 1]] + 1
    slept = edges[~awake[edges + 1]] + 1
    return [(int(slept[slept < w][-1]), int(w)) for w in woke if (slept < w).any()]


def unbroken(imu: ImuBlock) -> bool:
    """Return whether samples follow one another without a gap, or another clock."""
    steps_ns = np.diff(imu.stamp_ns)
    return bool(((steps_ns > 0) & (steps_ns <= GAP_NS)).all())


def share_per_s(away_ns: Stamps, longest_ns: int, mean_time_s: float) -> Floats:
    """Return which share of a turn a foot makes in a second, so far from the gyro's edge; it is 1 over `longest_ns`.

    A share (1 - t/T)^p, t from the edge and T as long as the turn may take, has the mean time T / (p + 2).
    """
    longest_s = longest_ns / NANOSECONDS
    power = min(max(longest_s / max(mean_time_s, 1e-3) - 2.0, 0.0), STEEPEST)
    return (power + 1.0) / longest_s * np.clip(1.0 - away_ns / longest_ns, 0.0, 1.0) ** power


def widths_s(asleep: ImuBlock, edge: ImuBlock) -> Floats:
    """Return for how long the rate of each sample counts where trapezia add them up, up to an edge at one end."""
    stamps = np.sort(np.concatenate([asleep.stamp_ns, edge.stamp_ns]))
    halves = 0.5e-9 * np.diff(stamps)
    widths = np.append(halves, 0.0) + np.insert(halves, 0, 0.0)
    return widths[1:] if edge.stamp_ns[0] < asleep.stamp_ns[0] else widths[:-1]
