"""The heading errors of two feet that walk together (paper 004, section 3).

Each foot's filter calls the direction of its own x axis at the start zero. So the feet's worlds are turned against each
other, by toe-out and by how the sensors sit on the shoes: ten degrees and more, which the paper puts into the bias of
eq. 4. That is no error of a filter whose yaw is zero by definition, and it would not take it. So what the first
straight strides show is split by eq. 4: the part that was there at the start is the frame of the foot, by which its
world is turned from that of the body; the part that has grown since, the drift, is fed back. The mean of both is kept.

All headings here are as if no foot had ever been told anything: what it has taken is added again. So the loop needs no
model, and nothing is counted twice: what a foot is told is the error so far less what it has taken. A filter of 15
states learns a gyro bias from that, so its track drifts less and less; the drift of the four states follows.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.fusion.heading_error import HeadingError
from pdr_core.fusion.stride_headings import STRIDES, Straight, StrideHeadings, walking_direction_rad
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import FusionParams
from pdr_core.records import StepEvent

UNKNOWN_SD_RAD = 0.2  # of the frames before the first strides: how sensors sit on shoes
GUESS_SD_RAD = 0.1  # and before a straight line has shown them


class Correction(NamedTuple):
    """By how much a track is turned too far, counter-clockwise."""

    turn_rad: float
    variance_rad2: float


class KnownFrame(NamedTuple):
    """How the world of a foot's filter lies in that of the body."""

    turn_rad: float  # body's world from the foot's
    sd_rad: float
    toe_rad: float  # by how much the standing foot points to the left of where it goes


@dataclass
class DualFoot:
    """What is known of the heading of one foot."""

    headings: StrideHeadings
    error: HeadingError | None = None  # against the walking direction; None: they have not walked straight yet
    measured: int = 0  # straight strides
    start_rad: float = 0.0  # the part of the error that was there at the start
    start_sd_rad: float = UNKNOWN_SD_RAD
    taken_rad: float = 0.0  # what its filter has been turned back by so far
    toe_rad: float = 0.0
    first_ns: int = 0  # when it began to walk
    last: StepEvent | None = None

    @property
    def walked_s(self) -> float:
        """How long it has walked."""
        return (self.last.stamp_ns - self.first_ns) / NANOSECONDS if self.last else 0.0


class DualHeading:
    """Takes the steps of both feet in order; tells by how much the track of the one that stepped is turned too far."""

    def __init__(self, params: FusionParams, feet: Sequence[str]) -> None:
        self._params = params
        self._feet = {foot: self._fresh() for foot in feet}
        self._shares = dict.fromkeys(feet, 0.5)  # of what turns their worlds against each other

    def _fresh(self) -> DualFoot:
        p = self._params
        return DualFoot(StrideHeadings(Straight(p.straight_sd_rad, p.straight_turn_rad), p.stride_min_m))

    def step(self, foot: str, step: StepEvent) -> Correction | None:
        """Take a step; return by how much its foot is turned too far, beyond what it has taken; None: unknown."""
        one, other = self._follow(foot, step), self._other(foot)
        together = other is not None and walk_together(step, other.last)
        if other and together and one.headings.straight and other.headings.straight:
            one.toe_rad = one.headings.toe_rad
            if one.error is None:
                one.error = self._begun(one, other)
            else:
                self._measure(one, other, one.error)
        elif other and together and not one.measured and len(one.headings):
            self._guess(one, other)
        return self._correction(one)

    def begin(self, lost: str) -> None:
        """Forget what is known: a foot is in another world, and the other one's stays where it is."""
        self._feet = {foot: self._fresh() for foot in self._feet}
        self._shares = {foot: float(foot == lost) for foot in self._feet}

    def turned_back(self, foot: str, turn_rad: float) -> None:
        """Note that the filter of a foot has turned its track back."""
        self._feet[foot].taken_rad += turn_rad

    def _follow(self, foot: str, step: StepEvent) -> DualFoot:
        one = self._feet[foot]
        if one.last is None:
            one.first_ns = step.start_ns
        one.headings.add(step, one.taken_rad)
        if one.error:
            one.error.predict(step.displacement_m, (step.stamp_ns - step.start_ns) / NANOSECONDS)
        one.last = step
        return one

    def _other(self, foot: str) -> DualFoot | None:
        return next((other for name, other in self._feet.items() if name != foot), None)

    def _guess(self, one: DualFoot, other: DualFoot) -> None:
        """Until they have walked straight, take it that they went where their latest strides went together."""
        strides = min(len(one.headings) - 1, len(other.headings)) or 1
        if not len(other.headings):
            return
        one.toe_rad = one.headings.toe_rad
        one.start_rad = deviation_rad(one.headings.mean_rad(strides + 1), other.headings.mean_rad(strides))
        one.start_sd_rad = GUESS_SD_RAD
        other.start_rad, other.start_sd_rad = -one.start_rad, GUESS_SD_RAD

    def _begun(self, one: DualFoot, other: DualFoot) -> HeadingError:
        """Return the errors as the first straight strides show them, from the middle of these on.

        One stride less of the other foot has the same middle, so a steady curve turns nothing here either.
        """
        p = self._params
        against_rad = deviation_rad(one.headings.mean_rad(), other.headings.mean_rad(STRIDES))
        error = HeadingError(against_rad, noise_rad2(one, other, p) / STRIDES, p.drift_sd_radps, p.heading_noise_rad)
        error.predict(np.zeros(2), 0.5 * one.headings.duration_s)
        return error

    def _measure(self, one: DualFoot, other: DualFoot, error: HeadingError) -> None:
        """Compare the heading of a foot with the walking direction, both of the moment when the other one stood.

        The other foot's latest stride lies half a stride before that of this foot, and half a stride behind the one
        before it. So with the mean of these two a steady curve turns nothing.
        """
        against_rad = deviation_rad(one.headings.mean_rad(2), other.headings.mean_rad(1))
        error.measure(against_rad, noise_rad2(one, other, self._params))
        one.measured += 1
        if one.measured <= self._params.frame_strides:
            one.start_rad, variance_rad2 = error.turn_before(one.walked_s)
            one.start_sd_rad = float(np.sqrt(variance_rad2))

    def _correction(self, one: DualFoot) -> Correction | None:
        """Return what has grown since the start and is not yet taken."""
        if one.error is None or one.measured < self._params.frame_strides:
            return None
        turn_rad = one.error.turn_rad - one.start_rad - one.taken_rad
        return Correction(turn_rad, one.error.turn_variance_rad2 + one.start_sd_rad**2) if turn_rad else None

    @property
    def aligned(self) -> bool:
        """A straight line has shown the frames of all feet."""
        return all(foot.measured for foot in self._feet.values())

    def known(self, foot: str) -> KnownFrame | None:
        """Return how the world of a foot lies in that of the body; None: it is the only one."""
        one, other = self._feet[foot], self._other(foot)
        if not other:
            return None
        share, sd_rad = self._shares[foot], math.hypot(one.start_sd_rad, other.start_sd_rad)
        turn_rad = -share * wrapped_rad(one.start_rad - other.start_rad)
        return KnownFrame(turn_rad, 2.0 * share * math.sqrt(0.5) * sd_rad, one.toe_rad)


def walk_together(step: StepEvent, other: StepEvent | None) -> bool:
    """Tell whether the latest stride of the other foot ended within this one."""
    return other is not None and step.start_ns < other.stamp_ns <= step.stamp_ns


def deviation_rad(heading_rad: float, other_rad: float) -> float:
    """Return a heading minus the walking direction that both feet have (paper 004 eq. 6)."""
    return wrapped_rad(heading_rad - walking_direction_rad([heading_rad, other_rad]))


def noise_rad2(one: DualFoot, other: DualFoot, params: FusionParams) -> float:
    """Return the variance of half the difference of two headings, from how much each foot's spread."""
    spread_rad2 = 0.25 * (one.headings.variance_rad2 + other.headings.variance_rad2)
    return max(spread_rad2, params.heading_sd_min_rad**2)
