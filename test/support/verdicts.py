"""Verdicts without samples, for what looks at verdicts and stamps alone, and how long real ones take."""

import numpy as np

from pdr_core.records import ImuBlock, StanceBlock, inertial_block, length, part
from pdr_core.stance import StanceDetection

PERIOD_NS = 5_000_000


def verdicts(*spans: tuple[float, bool], start_ns: int = 10**18) -> StanceBlock:
    """Return samples at 200 Hz whose verdicts are (seconds, does the foot rest?), one span after the other."""
    resting = np.concatenate([np.full(round(seconds * 200), rests) for seconds, rests in spans])
    n = len(resting)
    stamps = start_ns + PERIOD_NS * np.arange(n, dtype=np.int64)
    imu = inertial_block(stamps, np.zeros((n, 3)), np.zeros((n, 3)), np.zeros(n), np.zeros(n))
    return StanceBlock(imu, resting, np.zeros(n), np.zeros(n), np.zeros(n), np.zeros((n, 3)), np.zeros(n))


def span_of(at: int, *spans: tuple[float, bool]) -> slice:
    """Return which samples belong to a span."""
    counts = [round(seconds * 200) for seconds, _ in spans]
    begin = sum(counts[:at])
    return slice(begin, begin + counts[at])


def longest_wait_s(stage: StanceDetection, imu: ImuBlock) -> float:
    """Return by how much, by the stamps, a verdict follows its sample at most where samples come one by one."""
    waited_ns = [imu.stamp_ns[i] - stage.run(part(imu, i, i + 1)).imu.stamp_ns for i in range(length(imu))]
    return float(np.concatenate(waited_ns).max()) / 1e9
