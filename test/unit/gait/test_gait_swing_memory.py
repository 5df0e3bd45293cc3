"""The impulse of a swing against the change of speed that the forces were made of."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.gait import swing_memory as memory
from pdr_core.gait.stands import STAND
from pdr_core.maths.memory import fresh

AHEAD_MPS2, LEFT_MPS2 = np.array([0.0, 3.0, 5.0, -2.0, -6.0, 1.0]), np.array([0.0, 0.5, -1.0, 2.0, 0.25, 0.0])
STEP_NS = np.array([5, 6, 4, 5, 20]) * 1_000_000  # uneven: a force lasts until the next sample


def remembered(foot_from_level):
    """A memory of a swing whose first sample stands, the axes of the foot fixed."""
    s, stamp_ns = fresh(memory.MEMORY)[0], np.append(0, np.cumsum(STEP_NS))
    memory.begin_anew(s)
    s.left_ns = stamp_ns[0]
    level = np.column_stack([AHEAD_MPS2, LEFT_MPS2, np.full(len(stamp_ns), STANDARD_GRAVITY_MPS2)])
    for at_ns, force in zip(stamp_ns, foot_from_level.apply(level), strict=True):
        memory.append(int(at_ns), tuple(force), (0.0, 0.0, 0.0), -1.0, s)
    return s, stamp_ns


@pytest.mark.parametrize(("roll", "pitch"), [(0.0, 0.0), (0.3, 0.0), (0.0, -0.4), (0.5, 0.7)])
@pytest.mark.parametrize("share", [0.5, 1.0])
def test_the_impulse_is_the_change_of_speed_along_the_level_axes_of_the_stand(roll, pitch, share):
    s, stamp_ns = remembered(Rotation.from_euler("xyz", [roll, pitch, 0.0]).inv())
    memory.level_from(s.accel_mps2[0].copy(), s)
    stand = fresh(STAND)[0]
    memory.write_impulse(int(stamp_ns[-1]), share, s, stand)
    until = np.searchsorted(stamp_ns, share * stamp_ns[-1])
    lasted_s = STEP_NS[:until] * 1e-9
    assert stand.impulse_known
    np.testing.assert_allclose(
        stand.impulse_mps, [AHEAD_MPS2[:until] @ lasted_s, LEFT_MPS2[:until] @ lasted_s], atol=1e-12
    )


def test_without_a_stand_no_impulse_is_known():
    s, stamp_ns = remembered(Rotation.identity())
    stand = fresh(STAND)[0]
    memory.write_impulse(int(stamp_ns[-1]), 1.0, s, stand)
    assert not stand.impulse_known
