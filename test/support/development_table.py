"""The figures of one setting on the development recordings, as the tables of pdr_core/docs/navigation.md show them."""

from typing import NamedTuple

import numpy as np

from pdr_core.params import Params
from support.held_recordings import TILES, VICON, XIO, Held, results


class Row(NamedTuple):
    """One line of the table."""

    vicon_mean_m: float
    vicon_median_m: float
    vicon_worst_m: float
    tiles_mean_m: float
    strides_wrong: float  # by how many the counts of the tile walks are off
    xio_closure_m: float


def measured(walks: dict[str, Held], params: Params) -> Row:
    """Return the figures of recordings by folder with these parameters."""
    found = {folder: list(results(group, params).values()) for folder, group in walks.items()}
    vicon_m, tiles_m = ([r.truth.ate2_m for r in found[folder]] for folder in (VICON, TILES))
    wrong = sum(abs(r.strides - r.truth.stride_count_true) for r in found[TILES])
    mean_m, median_m = float(np.mean(vicon_m)), float(np.median(vicon_m))
    return Row(mean_m, median_m, max(vicon_m), float(np.mean(tiles_m)), wrong, found[XIO][0].closure_2d_m)


def line(name: str, row: Row) -> str:
    """Return a line of Markdown."""
    numbers = [f"{x:.0f}" if figure == "strides_wrong" else f"{x:.3f}" for figure, x in row._asdict().items()]
    return f"| {' | '.join([name, *numbers])} |"
