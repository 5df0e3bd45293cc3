"""Changes of gyro power and rate hold from the stamp that is asked for."""

import numpy as np
import pytest

from pdr_core.records import joined
from pdr_nodes.devices.player import Player
from pdr_nodes.devices.source import Source
from support.walks import BEGIN_NS, still

STEP_NS = 10_000_000
SETTLING_S = 0.05
SAMPLES = 200


@pytest.fixture
def player():
    return Player(Source("test", iter([still(SAMPLES / 100.0, BEGIN_NS)]), None), SETTLING_S)


def at(sample):
    return BEGIN_NS + sample * STEP_NS


def rest(player):
    """What the player still has."""
    taken = []
    while player.next is not None:
        taken.append(player.take())
    return joined(taken)


def measures(block):
    return block.gyro_sd_radps >= 0.0


def test_a_gyro_is_off_from_the_first_sample_at_or_after_a_stamp(player):
    assert player.set_gyro_power(False, at(50) - 1) == at(50) - 1
    assert player.set_gyro_power(True, at(100)) == at(100)
    expected = (np.arange(SAMPLES) < 50) | (np.arange(SAMPLES) >= 105)
    np.testing.assert_array_equal(measures(rest(player)), expected)


def test_a_stamp_in_the_past_is_as_soon_as_possible(player):
    for _ in range(30):
        player.take()
    assert player.set_gyro_power(False, at(3)) == at(30)
    assert not measures(rest(player)).any()


def test_changes_happen_in_the_order_of_their_stamps_however_they_are_asked_for(player):
    player.set_gyro_power(True, at(120))
    player.set_gyro_power(False, at(40))
    off = np.flatnonzero(~measures(rest(player)))
    assert (off[0], off[-1]) == (40, 124)


def test_of_two_changes_at_one_stamp_the_last_one_holds(player):
    player.set_gyro_power(False, at(40))
    player.set_gyro_power(True, at(40))
    off = np.flatnonzero(~measures(rest(player)))
    assert off.tolist() == [40, 41, 42, 43, 44], "it settles"


def test_a_change_after_the_end_never_happens(player):
    player.set_gyro_power(False, at(SAMPLES))
    assert measures(rest(player)).all()
    with pytest.raises(EOFError):
        player.set_gyro_power(False)


def test_a_rate_holds_from_its_stamp_on(player):
    player.take()
    assert player.set_sample_rate(25.0, at(80)) == (pytest.approx(25.0), at(80))
    gaps = np.diff(rest(player).stamp_ns) // STEP_NS
    assert gaps.tolist() == [1] * 79 + [4] * 29


def test_a_lower_rate_does_not_show_a_vibration_as_motion():
    shaking = still(SAMPLES / 100.0, BEGIN_NS)
    shaking.accel_mps2[::4, 0] += 8.0  # 25 Hz: every 4th sample alone sees a steady push
    player = Player(Source("test", iter([shaking]), None), SETTLING_S)
    player.take()
    player.set_sample_rate(25.0, at(80))
    taken = rest(player)
    slow = taken.accel_mps2[taken.stamp_ns > at(84), 0][:-5]
    assert len(slow) > 20
    np.testing.assert_allclose(slow, 2.0, atol=0.05)  # the mean push
    fast = taken.stamp_ns < at(80)
    np.testing.assert_array_equal(taken.accel_mps2[fast], shaking.accel_mps2[1:80])
