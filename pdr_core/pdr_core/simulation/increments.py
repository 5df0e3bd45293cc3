"""What a sensor gives that integrates internally: means over the intervals, which the mechanisation inverts exactly.

The mechanisation turns by Exp(rate dt), so the mean rate is Log(R_before' R_after) / dt (the inverse of Gui eq. 3). It
feels one force f at both ends of the interval, so the velocity grows by (mean R f - g) dt with mean R = (R_before +
R_after) / 2, and f is solved from that (the inverse of Gui eq. 4-6).

It moves the position by the trapezium (v_before + v_after) dt / 2 (Gui eq. 7), which misses the true displacement by
d_i = p_i - p_(i-1) - (v_(i-1) + v_i) dt_i / 2. The misses of exact velocities add up. So the velocity at stamp i
carries c_i = 2 d_i / (dt_i + dt_(i+1)) more: half of it moves the interval before the stamp and half the one after,
together by c_i (dt_i + dt_(i+1)) / 2 = d_i. So every miss is made up within the next interval, for any stamps and any
time, and the position is off by no more than about d_i / 2.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Floats, Stamps


def interval_means(
    stamp_ns: Stamps, position_m: Floats, velocity_mps: Floats, quat_xyzw: Floats, gravity_mps2: float
) -> tuple[Floats, Floats]:
    """Return the mean rate [rad/s] and specific force [m/s^2] over the interval before each stamp, (n, 3) each.

    Position, velocity (n, 3) and attitude (n, 4) are true, in the world frame. The foot rests before the first stamp.
    """
    dt_s = np.diff(stamp_ns)[:, None] / NANOSECONDS
    attitude = Rotation.from_quat(quat_xyzw)
    rate = (attitude[:-1].inv() * attitude[1:]).as_rotvec() / dt_s
    accel = np.diff(carrying_misses(dt_s, position_m, velocity_mps), axis=0) / dt_s
    R = attitude.as_matrix()
    mean_R = np.concatenate([R[:1], 0.5 * (R[:-1] + R[1:])])
    world_force = np.concatenate([np.zeros((1, 3)), accel]) + np.array([0.0, 0.0, gravity_mps2])
    return np.concatenate([np.zeros((1, 3)), rate]), np.linalg.solve(mean_R, world_force[..., None])[..., 0]


def carrying_misses(dt_s: Floats, position_m: Floats, velocity_mps: Floats) -> Floats:
    """Return the velocities (n, 3) with what the trapezium misses of the positions; intervals (n - 1, 1)."""
    missed_m = np.diff(position_m, axis=0) - 0.5 * (velocity_mps[:-1] + velocity_mps[1:]) * dt_s
    next_dt_s = np.concatenate([dt_s[1:], dt_s[-1:]])
    return velocity_mps + np.concatenate([np.zeros((1, 3)), 2.0 * missed_m / (dt_s + next_dt_s)])
