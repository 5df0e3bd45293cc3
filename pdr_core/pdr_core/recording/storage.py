"""What is known of a file of a bag, whatever its format."""

from collections.abc import Callable, Collection, Iterator
from pathlib import Path
from typing import NamedTuple

Messages = Callable[[Collection[str]], Iterator[tuple[str, bytes]]]


class Storage(NamedTuple):
    """One file of a bag. `messages(topics)` yields topic and CDR bytes, and raises anything where it is damaged."""

    path: Path
    topics: dict[str, str]  # message type by topic
    messages: Messages
