"""A switched foot once more, from its judged samples and from when the nodes have told it of its model."""

from collections.abc import Iterator

import numpy as np

from pdr_core.pipeline import AdaptiveFoot
from pdr_core.pipeline.adaptive_foot import PIECE_NS, Moved
from pdr_core.records import StanceBlock
from pdr_nodes.convert import stamp_ns


def moved_again(foot: AdaptiveFoot, judged: StanceBlock, walks: list) -> Iterator[Moved]:
    """Yield what each piece of samples makes known; `walks`: what the node has said of them, `WalkStatus`."""
    forgotten_ns = {stamp_ns(message.header.stamp) for message in walks if message.model_forgotten}
    stamps, moving = judged.imu.stamp_ns, foot.run(judged)
    for end_ns in stamps[np.flatnonzero(np.diff(stamps // PIECE_NS))].tolist():
        if end_ns in forgotten_ns:
            foot.forget_length()
        yield next(moving)
