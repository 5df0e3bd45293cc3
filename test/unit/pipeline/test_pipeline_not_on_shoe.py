"""A card on the chest that is taken for a foot: nothing there stands, and what is said of it names what to do."""

import pytest

from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.records import Level
from support import chest
from support.walks import straight_walk


def lost(imu):
    """What is said of a foot that never stands."""
    foot = FootInertial(Params())
    foot.run(imu)
    foot.finish()
    return [notice for notice in foot.notices if notice.kind == "no_stance"]


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_a_card_on_the_chest_is_told_what_it_needs(seed):
    (notice,) = lost(chest.walk(seed).imu)
    assert notice.level is Level.ERROR
    assert "Worn on the chest it needs `--pipeline chest`" in notice.text
    assert "`pdr compare --detectors all` shows" in notice.text


def test_a_foot_is_not():
    assert lost(straight_walk(8).imu) == []
