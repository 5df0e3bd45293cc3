"""Numbers as a person says them."""

import math
from collections.abc import Sequence

from pdr_core.records import Notice


def counted(number: int, noun: str) -> str:
    """Return '1 stride' or '52 strides'."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def metres(length_m: float) -> str:
    """Return a length with as many digits as matter, '0.05 m' or '131 m', or 'unknown'."""
    if not math.isfinite(length_m):
        return "unknown"
    digits = 0 if abs(length_m) >= 99.95 else 1 if abs(length_m) >= 9.995 else 2
    return f"{length_m:.{digits}f} m"


def share(percent: float) -> str:
    """Return '0.4 %', or 'unknown'."""
    return f"{percent:.1f} %" if math.isfinite(percent) else "unknown"


def duration(seconds: float) -> str:
    """Return '0.8 s', '42 s', '1 min 40 s' or '2 h 5 min', or 'unknown'."""
    if not math.isfinite(seconds):
        return "unknown"
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    return f"{whole // 60} min {whole % 60} s" if whole < 3600 else f"{whole // 3600} h {whole % 3600 // 60} min"


def nothing_usable(recording: str, notices: Sequence[Notice]) -> str:
    """Return the sentence on a recording without a usable sample, with what the notices say of that."""
    why = "; ".join(notice.text for notice in notices)
    return f"{recording} holds no usable sample" + (f": {why}" if why else "")


def spoken(name: str) -> str:
    """Return a name of the code, `gait_phases`, as a person writes it."""
    return name.replace("_", " ")
