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

    @contextmanager
    def bar(self, title: str, steps: int) -> Iterator["Bar"]:
        """Give a bar of so many steps."""
        if not sys.stderr.isatty():
            yield Bar(plain_lines(title), steps)
            return
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        text = TextColumn("{task.description}")
        columns = (text, BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
        with Progress(*columns, console=Console(stderr=True), transient=True) as live:
            task = live.add_task(title, total=steps)
            yield Bar(lambda what: live.update(task, description=what), steps, lambda: live.advance(task))

    def say(self, text: str) -> None:
        """Say something beside the result."""
        print(text, file=sys.stderr, flush=True)


class Bar:
    """Work of known length."""

    def __init__(self, show: Callable[[str], None], steps: int, moved: Callable[[], None] = lambda: None) -> None:
        self._show = show
        self._steps = steps
        self._moved = moved
        self._done = 0

    def show(self, what: str) -> None:
        """Say what is under way."""
        self._show(f"{self._done + 1} of {self._steps}, {what}")

    def advance(self) -> None:
        """One step is done."""
        self._done += 1
        self._moved()


def plain_lines(title: str) -> Callable[[str], None]:
    """Return a function that prints the progress, but not too often."""
    last_s = time.monotonic()

    def show(text: str) -> None:
        nonlocal last_s
        if time.monotonic() - last_s >= PLAIN_PERIOD_S:
            last_s = time.monotonic()
            print(f"{title}: {text}", file=sys.stderr, flush=True)

    return show
