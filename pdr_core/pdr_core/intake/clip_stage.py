"""The repair of clipped rates as a stage: samples that may lie on a plateau are held back until it is over."""

import numpy as np

from pdr_core.conventions import nanoseconds
from pdr_core.intake.clip_repair import CONTEXT, ClipLimits, Waiting, repair
from pdr_core.params import IntakeParams
from pdr_core.records import NO_SAMPLES, Flags, ImuBlock, joined, length, part


class ClipRepair:
    """Holds samples back and gives them out, in order, with their rates repaired."""

    def __init__(self, params: IntakeParams) -> None:
        self._limits = ClipLimits(params.clip_smallest_radps, nanoseconds(params.clip_longest_s))
        self._samples, rates = NO_SAMPLES, NO_SAMPLES.gyro_radps
        self._waiting = Waiting(
            NO_SAMPLES.stamp_ns, rates, rates, np.zeros(0, np.bool_), np.zeros(3, np.int64), np.zeros((3, 2))
        )
        self._given = 0  # samples of `_samples` that were given out

    def run(self, block: ImuBlock) -> tuple[ImuBlock, Flags]:
        """Return the samples that are decided now, and which of them were clipped, (n,)."""
        return self._decided(block, final=False)

    def finish(self) -> tuple[ImuBlock, Flags]:
        """Return the samples that still wait, as they are."""
        return self._decided(NO_SAMPLES, final=True)

    def _decided(self, block: ImuBlock, final: bool) -> tuple[ImuBlock, Flags]:
        samples, old = joined([self._samples, block]), self._waiting
        waiting = Waiting(
            samples.stamp_ns,
            samples.gyro_radps,
            np.concatenate([old.repaired, block.gyro_radps]),
            np.concatenate([old.clipped, np.zeros(length(block), np.bool_)]),
            old.undecided.copy(),
            old.seen.copy(),
        )
        stop = repair(waiting, self._limits, final)
        out = part(samples, self._given, stop)._replace(gyro_radps=waiting.repaired[self._given : stop])
        clipped = waiting.clipped[self._given : stop]
        first = max(0, stop - CONTEXT)
        self._samples, self._given = part(samples, first), stop - first
        self._waiting = Waiting(
            waiting.stamp_ns[first:],
            waiting.measured[first:],
            waiting.repaired[first:],
            waiting.clipped[first:],
            waiting.undecided - first,
            waiting.seen,
        )
        return out, clipped
