"""The page of Cheng's walks: one HTML file that needs nothing else."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from pdr_core.evaluation import cheng_plots, course_plots, motion_plots
from pdr_core.evaluation.cheng_plots import Line
from pdr_core.evaluation.course_plots import CourseTrack
from pdr_core.evaluation.motion_plots import MotionTrack
from pdr_core.evaluation.page import page
from pdr_core.evaluation.qiu_page import PageWords, Pictures, TitledTable
from pdr_core.evaluation.report import Picture
from pdr_core.records import Floats

WORDS = PageWords(
    "Cheng's walks, simulated",
    "Simulated walks with a card on the chest, the sensor an ICM-20602",
    "Cheng's Table 2, over many seeds",
    "End error: Cheng eq. 23. Footfall error: root mean square over all footfalls, eq. 24. Tilt error: of one level "
    "axis while walking, without what the accelerometer's bias looks like.",
)


class ChengDrawn(NamedTuple):
    """One case of one seed: how every method moved, and how far off it was at every footfall."""

    name: str
    motions: Sequence[MotionTrack]
    truth: MotionTrack
    footfalls: Mapping[str, tuple[Floats, Floats]]


class GainDrawn(NamedTuple):
    """What is drawn of K."""

    convergence: Sequence[Line]  # figure 4 [s]
    objective: Sequence[Line]  # figures 5 and 6 [deg]
    tilt: Sequence[Line]  # the real loop [deg]
    ends: Sequence[Line]  # and its end error [m]
    tracks: Sequence[CourseTrack]  # figure 9: case 1 by different K
    truth: CourseTrack


def cheng_page(
    tables: Sequence[TitledTable], cases: Sequence[ChengDrawn], gain: GainDrawn, version: str, commit: str
) -> str:
    """Return the page as text."""
    shown = [Pictures(case.name, list(pictures(case, i))) for i, case in enumerate(cases)]
    shown.append(Pictures("The feedback K", list(gain_pictures(gain))))
    return page("walks.html.j2", words=WORDS, tables=tables, walks=shown, version=version, commit=commit)


def pictures(case: ChengDrawn, number: int) -> Iterator[Picture]:
    """Yield the figures of one case."""
    courses = [track.course for track in case.motions]
    plan = course_plots.courses(courses, case.truth.course).to_json()
    caption = "The tracks from above, as figure 7 of the paper; a click on a name hides it."
    yield Picture(f"plan-{number}", "Where the walk went", caption, plan)
    caption = "The distance to the truth whenever a foot comes down, as figure 8."
    yield Picture(f"falls-{number}", "At every footfall", caption, cheng_plots.footfalls(case.footfalls).to_json())
    caption = "In the world frame, as figure 10: zero at every stop."
    velocities = motion_plots.velocities(case.motions, case.truth).to_json()
    yield Picture(f"velocity-{number}", "Velocity", caption, velocities)
    caption = "As figure 11, with the truth that the paper does not have."
    yield Picture(f"attitude-{number}", "Attitude", caption, motion_plots.attitudes(case.motions, case.truth).to_json())
    caption = "The same less the truth. What is off at rest is what the accelerometer's bias looks like."
    off = motion_plots.attitude_errors(case.motions, case.truth).to_json()
    yield Picture(f"attitude-error-{number}", "Attitude, off by", caption, off)


def gain_pictures(gain: GainDrawn) -> Iterator[Picture]:
    """Yield the figures of K."""
    caption = "As figure 4: when an error is down to a tenth, at 50 corrections a second (eq. 21-22)."
    figure = cheng_plots.over_number(gain.convergence, "Convergence time [s]", "s")
    yield Picture("gain-time", "In theory: convergence", caption, figure.to_json())
    caption = (
        "As figures 5 and 6: eq. 18 with the paper's numbers, and with a period of 20 s. It is so flat below its "
        "minimum K* that only the closed form shows where that is."
    )
    figure = cheng_plots.over_number(gain.objective, "Attitude error [°]", "°")
    yield Picture("gain-theory", "In theory: the paper's objective", caption, figure.to_json())
    caption = (
        "Measured over all seeds of case 2, and as the covariances of the loop have it, whose minimum is the default."
    )
    figure = cheng_plots.over_rate(gain.tilt, "Tilt error [°]", "°")
    yield Picture("gain-tilt", "The real loop: attitude", caption, figure.to_json())
    caption = "A fast traditional filter has the worst attitude and the least end error: it forgets any speed."
    figure = cheng_plots.over_rate(gain.ends, "End error [m]", "m")
    yield Picture("gain-end", "The real loop: end error", caption, figure.to_json())
    caption = "Case 1 by different K, as figure 9."
    figure = course_plots.courses(gain.tracks, gain.truth)
    yield Picture("gain-tracks", "Where the walk went", caption, figure.to_json())
