"""Stamps as text, without a detour over floating point: nanoseconds in, nanoseconds out."""

from decimal import Decimal, InvalidOperation

from pdr_core.conventions import NANOSECONDS

NS_PER_UNIT = {"s": Decimal(NANOSECONDS), "ms": Decimal(1_000_000), "us": Decimal(1_000), "ns": Decimal(1)}
INT64_MAX = 2**63 - 1


def stamp_ns_from_text(text: str, ns_per_unit: Decimal = NS_PER_UNIT["s"]) -> int:
    """Return the stamp [ns] that a decimal number counts in units of `ns_per_unit`; ValueError if there is none."""
    try:
        stamp_ns = int((Decimal(text.strip()) * ns_per_unit).to_integral_value())
    except (InvalidOperation, OverflowError, ValueError) as error:
        raise ValueError(f"{text!r} is no time") from error
    if abs(stamp_ns) > INT64_MAX:
        raise ValueError(f"{text!r} is too long a time")
    return stamp_ns


def text_from_stamp_ns(stamp_ns: int) -> str:
    """Return a stamp [ns] as seconds with nine decimals."""
    seconds, nanoseconds = divmod(abs(stamp_ns), NANOSECONDS)
    return f"{'-' if stamp_ns < 0 else ''}{seconds}.{nanoseconds:09d}"
