"""Progress for people; silent where there is no terminal to show it on."""

import sys
from contextlib import contextmanager
from collections.abc import Callable, Iterator


class Terminal:
    """Shows progress on stderr, so that stdout stays clean for results."""

    @contextmanager
    def progress(self, title: str) -> Iterator[Callable[[str], None]]:
        """Show a spinner with a text that the caller renews."""
        if not sys.stderr.isatty():
            yield lambda _text: None
            return
        from rich.console import Console

        with Console(stderr=True).status(title) as status:
            yield lambda text: status.update(f"{title}: {text}")
