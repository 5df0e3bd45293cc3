"""The report: one HTML file that needs nothing else, neither a network nor a folder beside it."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from pdr_core.evaluation import gait_plots, mode_plots, plots
from pdr_core.evaluation.gait_words import gait_rows
from pdr_core.evaluation.page import page
from pdr_core.evaluation.plan import plan
from pdr_core.evaluation.result import LEVELS, Result, in_words
from pdr_core.evaluation.saving import Saving
from pdr_core.evaluation.score import TruthView
from pdr_core.evaluation.trace import Trace
from pdr_core.evaluation.words import counted, duration, metres, share
from pdr_core.records import TruthKind
from pdr_core.records_gait import Stride


class Card(NamedTuple):
    """One figure of the summary."""

    value: str
    label: str


class Picture(NamedTuple):
    """One figure with what it shows."""

    name: str  # its id on the page
    title: str
    caption: str
    json: str  # of plotly, which escapes every < in it


def write_report(
    path: Path, result: Result, trace: Trace, strides: Sequence[Stride], truth_view: TruthView | None
) -> None:
    """Write the report of one sensor's run to a file. Raise OSError where it cannot be written."""
    path.write_text(report(result, trace, strides, truth_view), encoding="utf-8")


def report(result: Result, trace: Trace, strides: Sequence[Stride], truth_view: TruthView | None) -> str:
    """Return the page as text."""
    pictures = list(_pictures(result, trace, strides, truth_view)) if len(trace.points.time_s) else []
    return with_pictures(result, [*_mode_pictures(result.saving), *pictures])


def with_pictures(result: Result, pictures: Sequence[Picture]) -> str:
    """Return the page of a result with its pictures."""
    return page(
        "report.html.j2",
        result=result,
        words=in_words(result),
        cards=_cards(result),
        pictures=pictures,
        calls=result.saving.rows() if result.saving else [],
        gait=gait_rows(result.gait) if result.gait else [],
        notices=[(LEVELS[n.level], n.text, counted(n.count, "time")) for n in result.notices],
        config=list(_rows(result.config)),
    )


def _cards(result: Result) -> list[Card]:
    """Return the summary: what was walked, and how far off it is as far as anybody knows."""
    cards = [Card(metres(result.distance_m), "walked"), Card(str(result.strides), f"{result.counts}s")]
    cards.append(Card(duration(result.duration_s), "recorded"))
    truth = result.truth
    if truth and truth.kind is not TruthKind.CLOSED_LOOP:
        cards.append(Card(metres(truth.ate2_m), "off on average (ATE2)"))
    if truth:
        cards.append(Card(metres(truth.end_error_m), f"off at the end: {share(truth.end_error_percent)} of the way"))
    else:
        cards.append(Card(metres(result.closure_2d_m), "from the start to the end"))
    if result.saving:
        energy = result.saving.energy
        cards.append(Card(share(100.0 * energy.gyro_on_share), "of the time the gyro was on"))
        cards.append(Card(share(100.0 * energy.sensor_saved_share), f"of the charge saved ({energy.part})"))
    return cards


def _pictures(result: Result, trace: Trace, strides: Sequence[Stride], view: TruthView | None) -> Iterator[Picture]:
    """Yield the figures from top to bottom."""
    steps, worn_on, counts = [stride.step for stride in strides], result.worn_on, result.counts
    caption = "The track from above, each footfall a circle. An ellipse shows how uncertain the position is (1 σ)."
    laid = " The truth is turned and moved onto the estimate, as for ATE2." if view else ""
    yield Picture("plan", "Where the walk went", caption + laid, plan(trace, steps, view).to_json())
    shaded = (
        "Below the threshold the foot counts as standing (shaded)" if worn_on == "foot" else "Shaded, the person rests"
    )
    caption = f"{shaded}: only then is the speed known to be zero."
    yield Picture("stance", f"When the {worn_on} stood", caption, plots.stance(trace).to_json())
    caption = f"The height of the {worn_on}; the band shows how uncertain it is (1 σ)."
    yield Picture("height", f"How high the {worn_on} was", caption, plots.height(trace, view).to_json())
    if view:
        caption = "Distance to the truth after it was laid onto the whole track."
        yield Picture("error", "How far off it was", caption, plots.error(view).to_json())
    else:
        caption = "No truth along the way: this is what the filter itself expects its error to be (1 σ)."
        yield Picture("error", "How far off it may be", caption, plots.deviation(trace).to_json())
    if steps:
        caption = f"Length and direction of each {counts}; 0° is the direction of x, left turns count up."
        figure = plots.strides(steps, counts)
        yield Picture("strides", f"{counts.capitalize()} by {counts}", caption, figure.to_json())
        yield from _gait_pictures(result, trace, strides)


def _mode_pictures(saving: Saving | None) -> Iterator[Picture]:
    """Yield what navigated when, and when the gyro was on, where it was switched."""
    if saving and saving.commands:
        caption = "What navigated, and for what; shaded: the gyro on. The table below says why."
        yield Picture("modes", "When the gyro was on", caption, mode_plots.modes(saving).to_json())


def _gait_pictures(result: Result, trace: Trace, strides: Sequence[Stride]) -> Iterator[Picture]:
    """Yield the figures of gait analysis: what nothing is known of is left out."""
    worn_on, counts = result.worn_on, result.counts
    caption = "How often each length occurs, with its kernel density and a normal distribution of the same mean."
    yield Picture("lengths", f"How long the {counts}s were", caption, gait_plots.lengths(strides, counts).to_json())
    if any(stride.pitch_cycle_rad is not None for stride in strides):
        caption = "From the end of one stance to the end of the next; heel up is positive."
        yield Picture("pitch", "How the foot tips", caption, gait_plots.pitch(strides).to_json())
    if any(stride.clearance_m is not None for stride in strides):
        caption = "Each footfall by its height, and how high the foot went above the line between two footfalls."
        yield Picture("climb", "Up and down", caption, gait_plots.climb(strides).to_json())
    caption = "All turns since the start added up; left turns count up, and nothing jumps at half a turn."
    yield Picture(
        "heading", "How far it turned", caption, gait_plots.heading(strides, trace, worn_on, counts).to_json()
    )
    caption = f"The velocity of the {worn_on} along the axes of the plan and upwards."
    yield Picture("velocity", f"How fast the {worn_on} was", caption, gait_plots.velocity(trace).to_json())


def _rows(config: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, str]]:
    """Yield the configuration flat: dotted name and value."""
    for name, value in config.items():
        if isinstance(value, Mapping):
            yield from _rows(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", str(value)
