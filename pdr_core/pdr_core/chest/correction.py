"""The complementary correction of the attitude (Cheng eq. 10-12), derived anew as a stable loop.

Let R be the estimated rotation, world from chest, and R = exp([p x]) R_true: the estimate is turned too far by p. Over
a step of uniform motion the mean force in the true world is g u, u up. In the estimated one it is, to first order,

    mean f = g (u + p x u).                                                                      (10)

Normalised to its own length, so that neither g nor its error enters, it tells the level part of p:

    e = f x u = (u + p x u) x u = -(p - u (u.p)) = -p_level                                       (11)

In truth its length is the sine of the angle between them. The chest's rate is w - gB - alpha (5), and a rate that is
added in the chest's axes turns the estimate: p' = R (rate error - alpha). With

    alpha = -K R' e,    so    p' = K e + R (rate error) = -K p_level + R (rate error),            (12)

the tilt error dies away by exp(-K t): K is in 1/s, and 1/K is its time constant. A step's e is known when the step is
over and is fed back during the next: a delay of about T, with which the loop is stable for K T < pi / 2. The yaw is not
seen: u.e = 0.

As printed, eq. 11 has g_n x f with g_n = (0, 0, -g), which is g^2 e, and eq. 12 alpha = +C K e with C = R in place of
its transpose. With eq. 5 both together are p' = +K g^2 p: the tilt runs to 180 degrees. K of about 1e-5, as the paper
has it, makes sense for the cross product that is not normalised and for a sample's time, which eq. 12 takes out twice.

What a step is worth: the mean force of a step is g u plus the change of velocity over the step by its duration. Who
walks a bend keeps her velocity v beside the chest, so (R_yaw end - R_yaw begin) v of that is known and taken out. The
rest is weight only where the speed is the same at both ends; so a start, a stop, and a step whose mean is too far from
level are left out (section 2.1). But nobody speeds up for many steps in a row: after `steady_steps` of them the tilt is
what is wrong (a sensor that was knocked), and the chest is levelled at once, K T = 1.

The traditional filter feeds each sample's f back, always: of a start it keeps K times the speed over g, 1 m/s being 6
degrees for K = 1.
"""

import numpy as np

from pdr_core.chest.settings import TRADITIONAL, Settings
from pdr_core.chest.state import ChestState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import from_rotation_vector, multiply, normalised, rows
from pdr_core.maths.vector import Triple, Vector, cross, dot, norm, rotated, scaled, transposed

UP = (0.0, 0.0, 1.0)


@compiled
def error(force: Vector) -> Triple:
    """Return e of eq. 11 for a force in the estimated world: minus the level part of the tilt error [rad], its sine."""
    return cross(scaled(1.0 / max(norm(force), 1e-9), force), UP)


@compiled
def feed_back(e: Vector, gain_per_s: float, until_ns: int, state: ChestState) -> None:
    """Let the next rates turn the attitude by K R' e (eq. 12), until a stamp at the latest."""
    R_chest_from_world = transposed(rows(state.quat_xyzw))
    state.feedback_radps[:] = scaled(gain_per_s, rotated(R_chest_from_world, e))
    state.feedback_until_ns = until_ns


@compiled
def feed_sample_back(stamp_ns: int, force_mps2: Triple, s: Settings, state: ChestState) -> None:
    """Feed the force of one sample back: the traditional filter."""
    if s.method == TRADITIONAL:
        e = error(rotated(rows(state.quat_xyzw), force_mps2))
        feed_back(e, s.traditional_per_s, stamp_ns + s.step_max_ns, state)


@compiled
def level_anew(force: Vector, state: ChestState) -> float:
    """Turn the estimated world so that a mean force in it points up; return by how much [rad]."""
    axis = error(force)
    length = norm(axis)
    angle = angle_from_up(force, length)
    if length > 1e-9:
        turn = from_rotation_vector(scaled(angle / length, axis))
        state.quat_xyzw[:] = normalised(multiply(turn, state.quat_xyzw))
    return angle


@compiled
def angle_from_up(force: Vector, sine: float) -> float:
    """Return the angle [rad] between a force and up, 0..pi, whose sine is known."""
    return np.arctan2(sine, dot(force, UP) / max(norm(force), 1e-9))
