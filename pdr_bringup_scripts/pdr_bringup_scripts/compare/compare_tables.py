"""The tables of `pdr compare` on the terminal."""

from rich.table import Table

from pdr_bringup_scripts.benches.suite_tables import table
from pdr_core.evaluation.detector_tables import TextTable

WIDTH = 160  # where no terminal says its own: no name is cut


def rich_table(title: str, text: TextTable) -> Table:
    """Return the table as the terminal shows it."""
    out = table(title, *text.heads, names=text.names)
    for row in text.rows:
        out.add_row(*row)
    return out
