"""A walk of the chest as stretches: stand, start, steps, stop; and turns on the spot between them."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from pdr_core.parameter import ParameterError
from pdr_core.records import Floats
from pdr_core.simulation.chest_person import SPEED_SHARE, SPEED_STEPS, STEP_SHARE, Person

REST_S = 5.0  # standing at both ends
STAND_S = 2.0  # before a turn on the spot, and after it: "stopping briefly" (Cheng section 4)
TURN_S = 1.5  # for 90 degrees: 60 deg/s in the mean, El-Gohary et al. 2014 (Sensors 14:356), as quoted elsewhere
RAMP_STEPS = 2  # a start and a stop, see chest_person
CALIBRATION_M = 10.0  # the stretch from stop to stop before a long one
STEPS = 21  # this stream of a seed


class Stretch(NamedTuple):
    """Straight ahead from stop to stop, then a turn on the spot."""

    length_m: float
    turn_rad: float


class Steps(NamedTuple):
    """When the feet come down in a stretch, and how fast the body is then; the first entry is the start, at rest."""

    time_s: Floats  # (steps + 1,) since the start of the stretch
    speed_mps: Floats  # (steps + 1,) 0 at both ends; what lies between two entries is a smooth change


def stretches(walk: str, length_m: float) -> list[Stretch]:
    """Return the stretches of a walk of this length; ParameterError if the chest does not walk it.

    A rectangle has a stop at every corner, and its sides are as 2 to 1; straight is one stretch without a stop, after
    a short one that shows how long steps are.
    """
    if walk == "still":
        return []
    if walk == "straight":
        return [Stretch(CALIBRATION_M, 0.0), Stretch(length_m, 0.0)]
    if walk == "rectangle":
        return [Stretch(length_m * share, np.pi / 2.0) for share in (1.0 / 3.0, 1.0 / 6.0) * 2]
    raise ParameterError(f"simulation.walk = '{walk}': the chest walks only rectangle, straight and still")


def steps(person: Person, length_m: float, rng: np.random.Generator) -> Steps:
    """Return the steps of a stretch; they vary as people's do, and add up to its length exactly.

    At a constant walk ratio the length of a step goes with the root of the speed, and so does its frequency.
    """
    walked = max(1, round(length_m / person.step_m) - RAMP_STEPS)  # a ramp is half as long as its steps
    u = slow(walked + 1, rng)
    speed = person.speed_mps * (1.0 + SPEED_SHARE * u)
    mean_mps = 0.5 * (speed[:-1] + speed[1:])
    share = mean_mps / person.speed_mps
    step_m = person.step_m * np.sqrt(share) * (1.0 + STEP_SHARE * rng.standard_normal(walked))
    step_s, first_s, last_s = step_m / mean_mps, person.step_s, person.step_s
    ramp_m = 0.5 * RAMP_STEPS * (speed[0] * first_s + speed[-1] * last_s)
    scale = length_m / (float(step_m.sum()) + ramp_m)
    gaps_s = np.concatenate([[first_s] * RAMP_STEPS, step_s, [last_s] * RAMP_STEPS])
    ramped = np.concatenate([ramp(speed[0]), speed, ramp(speed[-1])[::-1]])
    return Steps(np.concatenate([[0.0], np.cumsum(gaps_s)]), scale * ramped)


def ramp(speed_mps: float) -> Floats:
    """Return the speeds before a ramp has reached `speed_mps`, (RAMP_STEPS,): evenly from rest."""
    return speed_mps * np.arange(RAMP_STEPS) / RAMP_STEPS


def slow(count: int, rng: np.random.Generator) -> Floats:
    """Return a slow variation with deviation 1, (count,): each is nearly the one before."""
    keep = np.exp(-1.0 / SPEED_STEPS)
    fresh = rng.standard_normal(count)
    out = np.empty(count)
    out[0] = fresh[0]
    for i in range(1, count):
        out[i] = keep * out[i - 1] + np.sqrt(1.0 - keep**2) * fresh[i]
    return out


class Timeline(NamedTuple):
    """A whole walk as key times, from which smooth curves are made."""

    duration_s: float
    walks: list[tuple[float, Steps, float]]  # start [s], steps, direction [rad] of each stretch
    turns: list[tuple[float, float, float]]  # start [s], angle before and after [rad]


def timeline(person: Person, parts: Sequence[Stretch], seed: int) -> Timeline:
    """Return when everything happens."""
    rng = np.random.default_rng([seed, STEPS])
    now_s, direction_rad, walks, turns = REST_S, 0.0, [], []
    for part in parts:
        walked = steps(person, part.length_m, rng)
        walks.append((now_s, walked, direction_rad))
        now_s += float(walked.time_s[-1]) + STAND_S
        if part.turn_rad:
            turns.append((now_s, direction_rad, direction_rad + part.turn_rad))
            direction_rad += part.turn_rad
            now_s += TURN_S
        now_s += STAND_S
    return Timeline(now_s + REST_S - (STAND_S if parts else 0.0), walks, turns)


def footfalls_s(line: Timeline) -> Floats:
    """Return when feet come down while the person walks, (steps,)."""
    return np.concatenate([np.zeros(0), *_falls(line)])


def _falls(line: Timeline) -> Iterator[Floats]:
    for start_s, walked, _ in line.walks:
        yield start_s + walked.time_s[1:]
