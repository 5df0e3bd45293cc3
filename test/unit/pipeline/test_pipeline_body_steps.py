"""What is known of a body's steps: how far it and its way have turned since the step before."""

import numpy as np
import pytest

from pdr_core.pipeline import BodySteps, FootOutput
from support.chest import estimated, walk


def test_the_turns_of_a_rectangle_add_up():
    nav, steps, _ = estimated(walk(1).imu)
    strides = BodySteps().run(FootOutput(None, nav, steps))
    assert strides[0].turn_rad is None
    turned = np.cumsum([s.turn_rad for s in strides[1:]])
    assert turned[-5] == pytest.approx(1.5 * np.pi, abs=0.2)  # on the last side
    changed = np.cumsum([s.heading_change_rad for s in strides[1:]])
    assert changed[-5] == pytest.approx(1.5 * np.pi, abs=0.3)
    assert strides[5].clearance_m is strides[5].cadence_per_min is None
