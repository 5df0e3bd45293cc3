"""Absolute magnetic update: where the field is clean, its direction is a compass (Zhou eq. 10, matrix D, appendix A).

With m the field of a stance in the world frame as the filter has it, and e the attitude error, R_true = Exp(e) R, the
azimuth is off by e_z - (m_z / m_h^2) (m_x e_x + m_y e_y): that is H (`maths/magnetic.py`). Zhou's D is
[sin psi tan theta, -cos psi tan theta, 1]: so moves the Euler heading of the *foot* with the misalignment. But his
measured heading psi_M is levelled by the same attitude, so it moves too, with the dip. What counts is the difference
of both, as here; a test has it by finite differences.

Nobody knows where north lies in `odom`, whose x axis is where the foot first pointed. So north, the azimuth of the
field, is the sixteenth state, with its covariances beside P: C with the errors, V its own. It begins as the first
stance in a clean field shows it, and is learnt from all of them while the heading is still good. With r = north - alpha

    H_16 = [H, -1],     P_16 = [[P, C], [C', V]].

Other updates correct C but not north itself (Schmidt's consider state).
"""

import numpy as np

from pdr_core.eskf.error_state import ATTITUDE, SIZE
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.magnetic import UP, azimuth_by_rotation, azimuth_rad, dip_rad
from pdr_core.maths.vector import Vector, norm, product
from pdr_core.records import Floats


@compiled
def H(field_tesla: Vector) -> Floats:  # noqa: N802  (its usual name)
    """Return the Jacobian (1, 16) of the azimuth of a field (world frame) beside north."""
    out = np.zeros((1, SIZE + 1))
    out[0, ATTITUDE : ATTITUDE + 3] = azimuth_by_rotation(field_tesla)
    out[0, SIZE] = -1.0
    return out


@compiled
def residual(field_tesla: Vector, state: FilterState) -> Floats:
    """Return north minus the azimuth of a field (world frame), (1,), wrapped."""
    off = state.north_rad - azimuth_rad(field_tesla)
    return np.array([off - 2.0 * np.pi * np.round(off / (2.0 * np.pi))])


@compiled
def with_north(state: FilterState) -> Floats:
    """Return the covariance (16, 16) of the errors and of north."""
    P = np.empty((SIZE + 1, SIZE + 1))
    P[:SIZE, :SIZE] = state.P
    P[:SIZE, SIZE] = state.north_cross[:, 0]
    P[SIZE, :SIZE] = state.north_cross[:, 0]
    P[SIZE, SIZE] = state.north_variance
    return P


@compiled
def known(state: FilterState) -> bool:
    """Return whether north has been found."""
    return state.north_variance > 0.0


@compiled
def find(field_tesla: Vector, sd_rad: float, state: FilterState) -> None:
    """Take the field (world frame) of this stance for north: north = alpha_true + noise = alpha + H e + noise."""
    row = np.ascontiguousarray(H(field_tesla)[:, :SIZE])
    HP = product(row, state.P)
    state.north_norm_tesla, state.north_dip_rad = norm(field_tesla), dip_rad(UP, field_tesla)
    state.north_rad = azimuth_rad(field_tesla)
    state.north_cross[:] = HP.T
    state.north_ends[:] = product(row, state.cross)
    state.north_variance = product(HP, row.T)[0, 0] + sd_rad**2


@compiled
def split(P: Floats, state: FilterState) -> None:
    """Take the covariance (16, 16) apart."""
    state.P[:] = P[:SIZE, :SIZE]
    state.north_cross[:, 0] = P[:SIZE, SIZE]
    state.north_variance = P[SIZE, SIZE]
