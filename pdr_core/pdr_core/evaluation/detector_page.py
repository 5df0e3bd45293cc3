"""The page of compared detectors: one HTML file that needs nothing else."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from pdr_core.evaluation import detector_plots
from pdr_core.evaluation.detector_study import DetectorStudy
from pdr_core.evaluation.detector_tables import TextTable, by_choice, choice_text, figures, summaries, worth
from pdr_core.evaluation.page import page
from pdr_core.evaluation.report import Picture
from pdr_core.evaluation.words import counted, metres


class Part(NamedTuple):
    """A table with what it shows."""

    title: str
    caption: str
    table: TextTable


class Recording(NamedTuple):
    """What the page shows of one recording."""

    name: str
    table: TextTable
    pictures: list[Picture]


def detector_page(studies: Sequence[DetectorStudy], version: str, commit: str) -> str:
    """Return the page as text; of at least one study."""
    detectors = counted(len({choice.detector for choice in studies[0].scores}), "detector")
    return page(
        "detectors.html.j2",
        title=f"{detectors} on {counted(len(studies), 'recording')}",
        words=best(studies),
        tables=[part for part in parts(studies) if part.table.rows],
        recordings=[Recording(s.recording, figures([s]), list(pictures(s, i))) for i, s in enumerate(studies)],
        version=version,
        commit=commit,
    )


def best(studies: Sequence[DetectorStudy]) -> str:
    """Return which choice is the best in the mean, where any truth tells."""
    known = {choice: one.mean_m for choice, one in by_choice(studies).items() if one.recordings and not one.failed}
    if not known:
        return "No detector brings every recording home, or no recording knows its true path."
    detector, gate = choice_text(min(known, key=lambda choice: known[choice]))
    named = f"{detector} with the gate {gate}" if gate else detector
    return f"The mean error is least with {named}: {metres(min(known.values()))} (ATE2)."


def parts(studies: Sequence[DetectorStudy]) -> Iterator[Part]:
    """Yield the tables over all recordings."""
    caption = "ATE2 where the true path is known. Strides wrong: by how many the count of each walk is off, added up."
    yield Part("Each detector over all recordings", caption, summaries(studies))
    caption = "The setting at hand with one part of the method switched off at a time."
    yield Part("What each part of the method is worth", caption, worth(studies))
    if len(studies) > 1:
        yield Part("All figures", "Every detector on every recording.", figures(studies))


def pictures(study: DetectorStudy, number: int) -> Iterator[Picture]:
    """Yield the figures of one recording."""
    caption = "The foot stands where the statistic is below the threshold and no gate objects (shaded)."
    gaps = " The true speed has gaps where the truth repeats itself, as motion capture does that has lost the foot."
    drawn = detector_plots.detectors(study.curves, study.speed).to_json()
    yield Picture(f"detectors-{number}", "When the foot stands", caption + gaps * bool(study.speed), drawn)
    if study.windows:
        caption = "Swings between two stances, by the length of the detector's window (Qiu figure 6)."
        drawn = detector_plots.windows(study.windows, study.strides_true).to_json()
        yield Picture(f"windows-{number}", "Steps found by windows of every length", caption, drawn)
