"""Which step of the ZUPT filter is which stride of the accelerometer."""

from collections.abc import Sequence

from pdr_core.records import StepEvent
from pdr_core.records_gait import GaitStep


def paired(strides: Sequence[GaitStep], steps: Sequence[StepEvent]) -> list[tuple[GaitStep, StepEvent]]:
    """Return the pairs: the ground hit of a stride lies within its step, which ends when the foot leaves the ground.

    A step with two hits, or none, has no pair. Both rows ascend in time.
    """
    within: list[list[GaitStep]] = [[] for _ in steps]
    i = 0
    for stride in strides:
        while i < len(steps) and steps[i].stamp_ns < stride.stamp_ns:
            i += 1
        if i < len(steps) and steps[i].start_ns < stride.stamp_ns:
            within[i].append(stride)
    return [(hits[0], step) for hits, step in zip(within, steps, strict=True) if len(hits) == 1]
