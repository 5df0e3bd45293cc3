"""The page of compared methods of orientation: one HTML file that needs nothing else."""

from collections.abc import Iterator, Sequence

from pdr_core.evaluation import orientation_plots
from pdr_core.evaluation.detector_page import Part, Recording
from pdr_core.evaluation.orientation_study import OrientationStudy
from pdr_core.evaluation.orientation_tables import figures, gait, left_out
from pdr_core.evaluation.page import page
from pdr_core.evaluation.report import Picture
from pdr_core.evaluation.words import counted

GAIT_CAPTION = (
    "Strides: true ones that one step holds alone; false: steps that hold none. Lengths: of strides on which the foot "
    "turned by at most 20°, against the middle between heel and toe. The pitch of the foot against the line from heel "
    "to toe, the median offset of mid-stance taken off."
)


def orientation_page(studies: Sequence[OrientationStudy], version: str, commit: str) -> str:
    """Return the page as text; of at least one study."""
    recordings = [Recording(s.recording, figures([s]), list(pictures(s, i))) for i, s in enumerate(studies)]
    return page(
        "orientations.html.j2",
        title=f"{counted(len(studies[0].scores), 'method')} on {counted(len(studies), 'recording')}",
        left_out=list(left_out(studies)),
        tables=[part for part in parts(studies) if part.table.rows],
        recordings=recordings,
        version=version,
        commit=commit,
    )


def parts(studies: Sequence[OrientationStudy]) -> Iterator[Part]:
    """Yield the tables over all recordings."""
    yield Part("Strides and foot pitch against motion capture", GAIT_CAPTION, gait(studies))
    caption = "The error-state filter has its own position, all others the same: the drift of each swing taken off."
    yield Part("Tracks", caption, figures(studies))


def pictures(study: OrientationStudy, number: int) -> Iterator[Picture]:
    """Yield the figures of one recording."""
    if study.gait:
        caption = "Each method with its mean and standard deviation (Qiu figure 12)."
        drawn = orientation_plots.stride_errors(study.gait).to_json()
        yield Picture(f"lengths-{number}", "How far off the strides are", caption, drawn)
    if study.cycle:
        caption = "The cycle of the longest stride, from mid-stance to mid-stance (Qiu figure 13)."
        yield Picture(
            f"pitch-{number}", "The pitch of the foot", caption, orientation_plots.pitch(study.cycle).to_json()
        )
    if study.drift:
        caption = "Integrated all the way, and with the drift of each swing taken off (Qiu figure 7)."
        drawn = orientation_plots.velocities(study.drift).to_json()
        yield Picture(f"velocity-{number}", "Velocity before and after zero-velocity updates", caption, drawn)
