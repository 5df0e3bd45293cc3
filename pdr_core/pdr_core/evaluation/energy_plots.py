"""The curve of energy against accuracy: how long the gyro is on, and how far off a walk ends."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pdr_core.evaluation import style
from pdr_core.evaluation.style import COLOURS

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

SYMBOLS = ("circle", "square", "diamond")  # where the colours begin anew


class EnergyPoint(NamedTuple):
    """One walk, or the mean of some, by one scheme."""

    scheme: str
    walk: str
    gyro_percent: float
    end_error_percent: float


def energy_curve(walks: Sequence[EnergyPoint], means: Sequence[EnergyPoint]) -> "Figure":
    """Return the walks as small marks and the means as large ones, a colour for each scheme."""
    fig = style.figure("Gyro powered [% of the time]", "End error [% of the distance]")
    for i, mean in enumerate(means):
        colour, symbol = COLOURS[i % len(COLOURS)], SYMBOLS[i // len(COLOURS) % len(SYMBOLS)]
        add(fig, [p for p in walks if p.scheme == mean.scheme], mean.scheme, colour, f"{symbol}-open", 8, listed=False)
        add(fig, [mean], mean.scheme, colour, symbol, 15, listed=True)
    fig.update_xaxes(range=[-3, 103])
    fig.update_yaxes(rangemode="tozero")
    fig.update_layout(hovermode="closest")
    return fig


def add(
    fig: "Figure", points: Sequence[EnergyPoint], scheme: str, colour: str, symbol: str, size: int, *, listed: bool
) -> None:
    """Add the points of one scheme."""
    fig.add_scatter(
        x=style.listed(np.array([p.gyro_percent for p in points])),
        y=style.listed(np.array([p.end_error_percent for p in points])),
        text=[p.walk for p in points],
        name=scheme,
        legendgroup=scheme,
        showlegend=listed,
        mode="markers",
        marker={"color": colour, "size": size, "symbol": symbol},
        hovertemplate="%{text}: on %{x:.0f} %, off by %{y:.1f} %",
    )
