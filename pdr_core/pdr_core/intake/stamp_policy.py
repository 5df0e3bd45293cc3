"""The stamp policy: order, duplicates, strays, bursts, gaps and jumps of a stream, in one stage."""

import numpy as np

from pdr_core.conventions import NANOSECONDS, nanoseconds
from pdr_core.intake.stamp_faults import NOTICES
from pdr_core.intake.stamp_rules import StampLimits, judged
from pdr_core.intake.stamp_state import NOBODY, fresh_state
from pdr_core.notices import Tally
from pdr_core.params import IntakeParams
from pdr_core.records import NO_SAMPLES, ImuBlock, Notice, Stamps, joined, length


class StampPolicy:
    """Lets samples pass in the order of their stamps. Where the stamps jump or one is missing, a sample waits for one.

    What passes has increasing stamps, but where a jump back is told.
    """

    def __init__(self, params: IntakeParams) -> None:
        rate_hz = params.constant_rate_hz
        period_ns = round(NANOSECONDS / rate_hz) if rate_hz > 0.0 else 0
        self._limits = StampLimits(nanoseconds(params.restart_s), period_ns)
        self._state = fresh_state()
        self._waiting = NO_SAMPLES
        self._tally = Tally()

    def run(self, block: ImuBlock) -> ImuBlock:
        """Return the samples, of this block and one that waited, that pass now."""
        return self._judge(block, final=False)

    def finish(self) -> ImuBlock:
        """Return the sample that still waits for a later one, if one does."""
        return self._judge(NO_SAMPLES, final=True)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the stamps so far."""
        return self._tally.notices

    def _judge(self, block: ImuBlock, final: bool) -> ImuBlock:
        block = joined([self._waiting, block]) if length(self._waiting) else block
        fault, order, stamp_ns = judged(block, self._limits, self._state, final)
        self._tell(fault, block.stamp_ns)
        w, passed, straight = (self._state[name] for name in ("waiting", "passed", "straight"))
        self._waiting = NO_SAMPLES if w == NOBODY else ImuBlock._make(column[w : w + 1].copy() for column in block)
        if not (straight and passed == length(block)):
            block = ImuBlock._make(column[order[:passed]] for column in block)
        return block._replace(stamp_ns=stamp_ns[:passed])

    def _tell(self, fault: Stamps, stamp_ns: Stamps) -> None:
        if fault.any():
            for kind in np.unique(fault[fault > 0]):
                self._tally.add_flagged(*NOTICES[kind], fault == kind, stamp_ns)
