"""Step length compensation (Cheng eq. 13): L_i = L'_i + s (L_0 - L'_i).

L'_i is the level distance that was solved for step i and L_0 what it should be. Cheng takes the first step for L_0. A
body that starts from rest has not gone a step's length when its first foot comes down; so the first ones are those of
uniform motion after a rest, when the solution has had no time to drift, and L_0 is their mean so far.

Cheng calls s a factor of body parameters. It is a weight, 0 <= s <= 1. With a velocity error e along the way a step of
T seconds comes out too long by e T, and the compensation takes s of that back from position and velocity alike:

    e <- (1 - s) e + (L_0 - L_i true) s / T + g tilt T

A person's steps differ from their mean by r, and a tilt pushes the error on by q = g tilt T^2 a step. The s of the
least steady error is Kalman's: with k = q / r, s = (k sqrt(k^2 + 4) - k^2) / 2. Steps of 0.68 m in 0.55 s that differ
by 1.9 % (1.5 % of themselves, and half the 2.3 % of the speed; Collins and Kuo 2013), r = 0.013 m, and a tilt of 0.3
degrees, q = 0.015 m, give s = 0.66.

A length alone leaves the direction to the solution, and a velocity error to the side is never taken back. But people
walk ahead or turn, and do not walk sideways (section 2.1). So the step that should be, d_0, may have a direction too:
that of the first steps beside the chest's, turned with the chest. Then eq. 13 is one of level vectors,

    d_i = d'_i + s (d_0 - d'_i).

With the step its deviation moves towards that of d_0: of its length, and of where the chest points. Steps are taken to
be off to the same side all the time, so deviations add up straight.
"""

from math import sqrt

from pdr_core.chest.settings import Settings
from pdr_core.chest.state import ChestState
from pdr_core.maths.compiled import compiled


def best_share(tilt_push_m: float, step_sd_m: float) -> float:
    """Return s for what a tilt adds to the error of a step's length, and how far steps differ [m]."""
    k = tilt_push_m / step_sd_m
    return 0.5 * (k * sqrt(k**2 + 4.0) - k**2)


@compiled
def compensate(x_m: float, y_m: float, share: float, s: Settings, state: ChestState) -> None:
    """Move the end of the step that ends now towards the step that should be, and its velocity as much (eq. 13)."""
    if state.step_s <= 0.0:
        return
    for i, wanted_m in enumerate((x_m, y_m)):
        moved_m = share * (wanted_m - (state.position_m[i] - state.step_start_m[i]))
        state.position_m[i] += moved_m
        state.velocity_mps[i] += moved_m / state.step_s
    if s.directed:
        trust((x_m**2 + y_m**2) ** 0.5, share, s, state)


@compiled
def trust(length_m: float, share: float, s: Settings, state: ChestState) -> None:
    """Move what is known of the step as far towards what is known of the one that it should be."""
    solved_m = state.position_sd_m - state.step_start_sd_m
    expected_m = s.step_sd_m + state.yaw_sd_rad * length_m
    state.position_sd_m = state.step_start_sd_m + (1.0 - share) * solved_m + share * expected_m
    state.velocity_sd_mps = (1.0 - share) * state.velocity_sd_mps + share * expected_m / state.step_s


@compiled
def keep_level(s: Settings, state: ChestState) -> None:
    """Take back the height that a step on level ground has gained, and the mean velocity that gained it."""
    if s.level_ground and state.step_s > 0.0:
        gained_m = state.position_m[2] - state.step_start_m[2]
        state.position_m[2] -= gained_m
        state.velocity_mps[2] -= gained_m / state.step_s
