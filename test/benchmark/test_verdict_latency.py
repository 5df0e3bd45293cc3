"""How far behind the newest sample the verdict on a sample comes, by the stamps; `-s` shows the figures."""

import os
from pathlib import Path

import numpy as np
import pytest

from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.records import Floats, ImuBlock, length, part
from support.held_recordings import TILES, VICON, XIO, held, only

LIMIT_S = 0.15
CLIPPING_MOST = (VICON, "2017-11-27-11-18-11")
SOME = [CLIPPING_MOST, (TILES, "SensorConnectData_31"), (XIO, "short_walk")]


def latencies_s(samples: ImuBlock) -> Floats:
    """Give the chain one sample after the other; return for each verdict how much newer the newest sample was."""
    chain, waited = FootInertial(Params()), []
    newest_ns = np.maximum.accumulate(samples.stamp_ns)
    for i in range(length(samples)):
        waited.append(newest_ns[i] - chain.run(part(samples, i, i + 1)).judged.imu.stamp_ns)
    waited.append(newest_ns[-1] - chain.finish().judged.imu.stamp_ns)
    return np.concatenate(waited) / 1e9


def check(recordings: Path, folder: str, *names: str) -> None:
    for name, session in held(recordings, folder, names).items():
        (samples,) = only(session).pieces()
        waited_s = latencies_s(samples)
        print(f"\n{folder} {name}: {len(waited_s)} verdicts, median {np.median(waited_s):.3f} s", end="")
        print(f", 99 % {np.quantile(waited_s, 0.99):.3f} s, longest {waited_s.max():.3f} s", end="")
        assert len(waited_s) == len(np.unique(samples.stamp_ns)), name  # what came twice is judged once
        assert waited_s.max() <= LIMIT_S, name


@pytest.mark.parametrize(("folder", "name"), SOME)
def test_no_verdict_comes_late(recordings: Path, folder: str, name: str) -> None:
    check(recordings, folder, name)


@pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")
@pytest.mark.parametrize("folder", [VICON, TILES, XIO])
def test_no_verdict_on_any_recording_comes_late(recordings: Path, folder: str) -> None:
    check(recordings, folder)
