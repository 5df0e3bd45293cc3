"""How long a sample is under way through the running nodes, and what each node costs, at three rates. (--full)

At two of them also with a magnetometer.

A verdict needs later samples: that is the delay of the algorithm. The core alone, fed sample by sample, tells by the
stamps which sample each estimate waited for. From that sample's publication to the arrival of the estimate it is
transport: the work of the nodes and the messages between them. Both ends are the middleware's own times.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from pdr_core.params import Params, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import Floats, ImuBlock, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.warmup import warm_up
from support.live_run import SETTLED_S, Ear, LiveRun

LENGTH_M = 24.0  # 20 strides: half a minute with the standing at both ends
full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


@full
@pytest.mark.usefixtures("ros_environment")
@pytest.mark.parametrize(
    ("rate_hz", "magnetometer"), [(200.0, False), (200.0, True), (400.0, False), (1000.0, False), (1000.0, True)]
)
def test_no_sample_is_lost_on_the_way_to_the_filter(rate_hz: float, magnetometer: bool, tmp_path: Path) -> None:
    params = changed(Params(), "node", input_reliable=True, magnetometer=magnetometer)
    params = changed(params, "simulation", walk="straight", walk_length_m=LENGTH_M, sample_rate_hz=rate_hz)
    params = changed(params, "simulation", magnetometer=magnetometer)
    raw = simulated_walk(params.simulation, params.place).imu
    seconds = float(raw.stamp_ns[-1] - raw.stamp_ns[0]) / 1e9
    waited_for = newest_stamps(raw, params)
    run = LiveRun(params, length(raw), seconds, tmp_path)
    show(
        run,
        f"{rate_hz:.0f} Hz{', magnetometer' if magnetometer else ''}",
        len(run.ear.arrived) / seconds,
        delays_ms(run.ear, waited_for),
    )
    assert len(run.ear.sent) == length(raw)
    assert run.ear.taken == length(raw)
    assert len(run.ear.arrived) / seconds <= 1.01 * params.node.odom_rate_hz


def newest_stamps(raw: ImuBlock, params: Params) -> dict[int, int]:
    """Return for the stamp of each estimate that of the sample with which it comes out, both since the first [ns]."""
    warm_up()  # also for the nodes
    chain, newest = FootInertial(params), {}
    for i in range(length(raw)):
        for stamp_ns in chain.run(part(raw, i, i + 1)).nav.stamp_ns:
            newest[int(stamp_ns - raw.stamp_ns[0])] = int(raw.stamp_ns[i] - raw.stamp_ns[0])
    return newest


def delays_ms(ear: Ear, waited_for: dict[int, int]) -> dict[str, Floats]:
    """Return what each estimate waited for later samples, was under way after them, and both, (n,) [ms]."""
    begin_ns = min(ear.sent)
    since_ns = {stamp: stamp - begin_ns for stamp in ear.arrived if stamp - begin_ns > SETTLED_S * 1e9}
    trigger = {stamp: begin_ns + waited_for[since] for stamp, since in since_ns.items() if since in waited_for}
    waiting = [newest - stamp for stamp, newest in trigger.items()]
    transport = [ear.arrived[stamp] - ear.sent[newest] for stamp, newest in trigger.items()]
    together = [ear.arrived[stamp] - ear.sent[stamp] for stamp in trigger]
    delays = {"wait for later samples": waiting, "transport": transport, "together": together}
    return {name: np.array(delay_ns) / 1e6 for name, delay_ns in delays.items()}


def show(run: LiveRun, what: str, odometry_hz: float, delays: dict[str, Floats]) -> None:
    samples = f"{len(run.ear.sent)} samples, {run.ear.taken} of them in the filter"
    print(f"\n{what}: {samples}, odometry at {odometry_hz:.0f} Hz")
    for name, delay_ms in delays.items():
        p50, p99 = np.percentile(delay_ms, [50, 99])
        print(f"  {name:<24}p50 {p50:7.2f} ms   p99 {p99:7.2f} ms")
    for name, (share, memory_mb) in run.cost.items():
        print(f"  {name:<24}{100 * share:5.1f} % of a core{memory_mb:8.0f} MB")
    print(f"  {'all nodes':<24}{100 * sum(share for share, _ in run.cost.values()):5.1f} % of a core")
