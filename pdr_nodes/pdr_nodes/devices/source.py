"""What the driver needs of a device."""

from collections.abc import Iterator
from dataclasses import dataclass

from pdr_core.records import ImuBlock, Truth


@dataclass(frozen=True)
class Source:
    """A stream of samples, and what is known of where the sensor really was."""

    name: str
    pieces: Iterator[ImuBlock]
    truth: Truth | None
