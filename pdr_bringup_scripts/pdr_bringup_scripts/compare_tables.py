"""What `pdr compare` has found, on the terminal."""

from collections.abc import Sequence

from rich.table import Table

from pdr_bringup_scripts.bench_tables import console, table
from pdr_core.evaluation.detector_study import DetectorStudy
from pdr_core.evaluation.detector_tables import TextTable, figures, summaries, worth

WIDTH = 160  # where no terminal says its own: no name is cut


def show_comparison(studies: Sequence[DetectorStudy]) -> None:
    """Print the tables: with colours on a terminal, as plain text elsewhere."""
    out = console(WIDTH)
    out.print(rich_table("Stance detectors (closure: from the first position to the last)", figures(studies)))
    if len(studies) > 1 and (over_all := summaries(studies)).rows:
        out.print(rich_table("Over all recordings: ATE2 where the path is known, mean closure of loops", over_all))
    if (parts := worth(studies)).rows:
        out.print(rich_table("What each part of the method is worth", parts))


def rich_table(title: str, text: TextTable) -> Table:
    """Return the table as the terminal shows it."""
    out = table(title, *text.heads, names=text.names)
    for row in text.rows:
        out.add_row(*row)
    return out
