"""However the sensor sits on the foot, the track is as good; `-s` shows the figures.

Each walk is turned into random mountings after the fact. So it must be free of clipping: a clipped rate lies on the
range of one axis of the sensor, and turned it would not.
"""

import os
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.recording import Session
from pdr_core.records import ImuBlock
from support.held_recordings import VICON, Held, ate2_m, held, results, with_samples

UNCLIPPED = (
    "2017-11-22-11-23-25",
    "2017-11-22-11-49-03",
    "2018-02-09-11-16-53",
    "2018-02-09-11-19-39",
    "2018-02-22-10-08-52",
)
LARGEST_RATIO = 1.15
full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


def turned(session: Session, mounting: Rotation) -> Session:
    """Return the walk as a sensor in another mounting would have felt it."""

    def turn(samples: ImuBlock) -> ImuBlock:
        gyro_radps, accel_mps2 = mounting.apply(samples.gyro_radps), mounting.apply(samples.accel_mps2)
        return samples._replace(gyro_radps=gyro_radps, accel_mps2=accel_mps2)

    return with_samples(session, turn)


def ratio(walks: Held, mountings: int) -> float:
    """Return the mean ATE2 in random mountings over that in the recorded one."""
    recorded_m = ate2_m(walks)
    turns = Rotation.random(mountings, np.random.default_rng(1))
    turned_m = {name: [ate2_m({name: turned(walk, turn)})[name] for turn in turns] for name, walk in walks.items()}
    for name, errors_m in turned_m.items():
        print(f"\n{name}: recorded {recorded_m[name]:.4f} m, ", end="")
        print(f"turned {min(errors_m):.4f} .. {np.mean(errors_m):.4f} .. {max(errors_m):.4f} m", end="")
    recorded, anyhow = np.mean(list(recorded_m.values())), np.mean(list(turned_m.values()))
    print(f"\nmean {recorded:.4f} m recorded, {anyhow:.4f} m turned: {anyhow / recorded:.3f} times", end="")
    return float(anyhow / recorded)


def test_two_walks_in_two_mountings(recordings: Path) -> None:
    assert ratio(held(recordings, VICON, UNCLIPPED[1:3]), mountings=2) <= LARGEST_RATIO


@full
def test_five_walks_in_twenty_mountings(recordings: Path) -> None:
    walks = held(recordings, VICON, UNCLIPPED)
    clipped = {name: [n.kind for n in r.notices if n.kind.endswith("saturated")] for name, r in results(walks).items()}
    assert clipped == {name: [] for name in UNCLIPPED}
    assert ratio(walks, mountings=20) <= LARGEST_RATIO


@full
def test_every_unclipped_walk_in_twenty_mountings(recordings: Path) -> None:
    every = held(recordings, VICON)
    kinds = {name: {notice.kind for notice in result.notices} for name, result in results(every).items()}
    walks = {name: walk for name, walk in every.items() if not kinds[name] & {"gyro_saturated", "accel_saturated"}}
    assert len(walks) == 9
    assert ratio(walks, mountings=20) <= LARGEST_RATIO
