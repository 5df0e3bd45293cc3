"""What a step costs (Zhou Tables 8 and 9): operations on floats, and time, interpreted and compiled.

Operations and the time without a compiler come from a process of their own, see `zhou_count.py`. The compiled time is
that of the suite as it runs: what happens at every sample and in every stride is compiled, what hands it on is not.
Both methods take the same samples in the same pieces, in turn and several times; the best time of each counts, since
what else runs on the machine only adds to it.
"""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf

from pdr_core.bench.zhou_steps import METHODS, prepared
from pdr_core.bench.zhou_walks import RATES_HZ

SHORT_M, COMPILED_M = 12.0, 100.0
ROUNDS = 5


@dataclass(frozen=True)
class StepCost:
    """A step by one method at one rate."""

    method: str
    rate_hz: int
    operations: float
    interpreted_ms: float
    compiled_ms: float


def cost(seen: Callable[[str], object] = str, rates_hz: Sequence[int] = RATES_HZ) -> list[StepCost]:
    """Measure both methods at all rates; `seen` is told which."""
    found: list[StepCost] = []
    for rate_hz in rates_hz:
        seen(f"{rate_hz} Hz")
        found += at_rate(rate_hz)
    return found


def at_rate(rate_hz: int) -> list[StepCost]:
    """Measure both methods at one rate."""
    operations, interpreted = (interpreted_steps(rate_hz, SHORT_M, counting) for counting in (True, False))
    compiled = compiled_steps(rate_hz, COMPILED_M)
    return [
        StepCost(name, rate_hz, operations[name]["operations"], interpreted[name]["ms"], compiled[name])
        for name in METHODS
    ]


def interpreted_steps(rate_hz: int, length_m: float, counting: bool) -> dict[str, dict[str, float]]:
    """Return operations and time [ms] of a step by each method, in a process without a compiler."""
    how = "count" if counting else "time"
    count = "pdr_bringup_scripts.benches.zhou_count"
    command = [sys.executable, "-W", "ignore", "-m", count, str(rate_hz), str(length_m), how]
    told = subprocess.run(
        command, env={**os.environ, "NUMBA_DISABLE_JIT": "1"}, capture_output=True, text=True, check=True
    )
    found: dict[str, dict[str, float]] = json.loads(told.stdout)
    return found


def compiled_steps(rate_hz: int, length_m: float) -> dict[str, float]:
    """Return the time [ms] of a step by each method in this process."""
    walk = prepared(rate_hz, length_m)
    best = dict.fromkeys(METHODS, inf)
    for _ in range(ROUNDS):
        for name, method in METHODS.items():
            take = method(walk)
            start_s = time.process_time()
            take()
            best[name] = min(best[name], 1e3 * (time.process_time() - start_s) / walk.strides)
    return best
