"""The page of a calibrated magnetometer: one HTML file that needs nothing else."""

from collections.abc import Sequence
from typing import NamedTuple

from pdr_core.conventions import seconds_between
from pdr_core.evaluation import mag_plots
from pdr_core.evaluation.page import page
from pdr_core.evaluation.report import Card, Picture
from pdr_core.records import Floats, Stamps


class FieldView(NamedTuple):
    """Fields before and after a calibration, and how strong they should be."""

    stamp_ns: Stamps  # (n,)
    before_tesla: Floats  # (n, 3)
    after_tesla: Floats  # (n, 3)
    norm_tesla: float


def mag_page(recording: str, words: str, cards: Sequence[Card], view: FieldView, version: str) -> str:
    """Return the page as text."""
    return page("mag.html.j2", recording=recording, words=words, cards=cards, pictures=pictures(view), version=version)


def pictures(view: FieldView) -> list[Picture]:
    """Return the figures from top to bottom."""
    time_s = seconds_between(view.stamp_ns, int(view.stamp_ns[0]))
    sphere = mag_plots.spheres(view.before_tesla, view.after_tesla, view.norm_tesla)
    norms = mag_plots.strength(time_s, view.before_tesla, view.after_tesla, view.norm_tesla)
    ball = (
        "A magnetometer that is turned in one field shows points on a sphere about the origin. Iron that turns with it "
        "moves the sphere (hard iron) and makes it an ellipsoid (soft iron). Drag to look at it from all sides: holes "
        "are directions that were not seen."
    )
    even = "However the sensor is turned, the field is as strong: what is left is noise, or a field that was disturbed."
    return [
        Picture("sphere", "The sphere", ball, sphere.to_json()),
        Picture("strength", "How strong the field is", even, norms.to_json()),
    ]
