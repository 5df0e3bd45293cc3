"""Verdicts without samples, for what looks at verdicts and stamps alone."""

import numpy as np

from pdr_core.records import ImuBlock, StanceBlock

PERIOD_NS = 5_000_000


def verdicts(*spans: tuple[float, bool], start_ns: int = 10**18) -> StanceBlock:
    """Return samples at 200 Hz whose verdicts are (seconds, does the foot rest?), one span after the other."""
    resting = np.concatenate([np.full(round(seconds * 200), rests) for seconds, rests in spans])
    n = len(resting)
    stamps = start_ns + PERIOD_NS * np.arange(n, dtype=np.int64)
    imu = ImuBlock(stamps, np.zeros((n, 3)), np.zeros((n, 3)), np.zeros(n), np.zeros(n))
    return StanceBlock(imu, resting, np.zeros(n), np.zeros(n), np.zeros(n), np.zeros((n, 3)), np.zeros(n))


def span_of(at: int, *spans: tuple[float, bool]) -> slice:
    """Return which samples belong to a span."""
    counts = [round(seconds * 200) for seconds, _ in spans]
    begin = sum(counts[:at])
    return slice(begin, begin + counts[at])
