"""Progress for people: a live line on a terminal, now and then a plain line elsewhere."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

PLAIN_PERIOD_S = 10.0


class Terminal:
    """Shows progress on stderr, so that stdout stays clean for results."""

    @contextmanager
    def progress(self, title: str) -> Iterator[Callable[[str], None]]:
        """Give a function that shows how far the work is."""
        if not sys.stderr.isatty():
            yield plain_lines(title)
            return
        from rich.console import Console

        with Console(stderr=True).status(title) as status:
            yield lambda text: status.update(f"{title}: {text}")

    def say(self, text: str) -> None:
        """Say something beside the result."""
        print(text, file=sys.stderr, flush=True)


def plain_lines(title: str) -> Callable[[str], None]:
    """Return a function that prints the progress, but not too often."""
    last_s = time.monotonic()

    def show(text: str) -> None:
        nonlocal last_s
        if time.monotonic() - last_s >= PLAIN_PERIOD_S:
            last_s = time.monotonic()
            print(f"{title}: {text}", file=sys.stderr, flush=True)

    return show
