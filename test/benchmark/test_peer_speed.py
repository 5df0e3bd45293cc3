"""Beside us: gaitmap's RtsKalman, another compiled error-state filter with zero-velocity updates. (--full)

It does more in one way, smoothing backwards after filtering forwards, which a live track cannot, and less in others: 9
states, no intake, no steps, no output in the foot frame. It is installed in an environment of its own.
"""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from pdr_core.maths.levelling import levelled
from pdr_core.recording import open_recording
from pdr_core.records import ImuBlock, joined, length
from support.peers import PeerError, peer_output, peer_python
from support.stopwatch import samples_per_s
from support.walks import straight_walk

PEER = "gaitmap_speed"
ROUNDS = 5
LEVEL = slice(0, 20)  # samples in which the foot stands
full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


def real_or_simulated(request: pytest.FixtureRequest) -> tuple[str, list[ImuBlock]]:
    """Return walks and what they are."""
    try:
        recordings = request.getfixturevalue("recordings")
    except pytest.skip.Exception:
        return "a simulated walk", [straight_walk(100, 200.0).imu]
    sessions = [open_recording(path) for path in sorted((recordings / "pyshoe_vicon").glob("*.mat"))]
    return "the Vicon trials", [joined(list(s.pieces())) for session in sessions for s in session.sensors.values()]


def written(walks: list[ImuBlock], path: Path) -> Path:
    """Write what the peer needs of the walks."""
    arrays = {}
    for i, walk in enumerate(walks):
        arrays[f"gyro_radps_{i}"], arrays[f"accel_mps2_{i}"] = walk.gyro_radps, walk.accel_mps2
        arrays[f"quat_xyzw_{i}"] = np.array(levelled(walk.accel_mps2[LEVEL].mean(axis=0), 0.0))
        arrays[f"rate_hz_{i}"] = np.array(1e9 / np.median(np.diff(walk.stamp_ns)))
    np.savez(path, **arrays)
    return path


@full
def test_the_chain_is_faster_than_gaitmap(request: pytest.FixtureRequest, tmp_path: Path) -> None:
    try:
        python = peer_python(PEER)
    except PeerError as error:
        pytest.skip(f"gaitmap cannot be installed here: {error}")
    name, walks = real_or_simulated(request)
    peer = json.loads(peer_output(python, PEER, written(walks, tmp_path / "walks.npz"), ROUNDS))
    ours = samples_per_s(walks, ROUNDS)
    theirs = peer["samples_per_s"]
    ours["stance and filter"] = 1.0 / (1.0 / ours["stance"] + 1.0 / ours["filter"])
    print(f"\n{sum(map(length, walks))} samples of {name}, best of {ROUNDS} rounds, processor time; samples/s:")
    print(f"  gaitmap, detector, filter and smoother {theirs:>10,.0f}, after {peer['compile_s']:.0f} s of compiling")
    for what, speed in ours.items():
        print(f"  pdr, {what:<34}{speed:>10,.0f} = {speed / theirs:5.2f} of gaitmap")
    assert ours["all together"] > theirs
