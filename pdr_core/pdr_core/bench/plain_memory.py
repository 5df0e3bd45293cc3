"""What the stages remember, in plain objects instead of numpy records: for who runs them without a compiler.

Python looks up a field of a numpy record fifty times as slowly as an attribute, and that would be most of the time.
"""

from typing import Any

import numpy as np

from pdr_core.eskf import state, zupt_filter
from pdr_core.maths import memory


class Plain:
    """What a numpy record holds, as attributes."""

    def __init__(self, kind: np.dtype) -> None:
        for name in kind.names or ():
            field = kind[name]
            zeros = np.zeros(field.shape, field.base)
            setattr(self, name, Plain(field) if field.names else zeros if field.shape else zeros.item())

    def __getitem__(self, name: str) -> Any:
        """Return a field."""
        return getattr(self, name)

    def __setitem__(self, name: str, value: Any) -> None:
        """Write a field; an array stays the same one."""
        if isinstance(getattr(self, name), np.ndarray):
            getattr(self, name)[...] = value
        else:
            setattr(self, name, value)


def remember_plainly() -> None:
    """Let the filter and dead reckoning keep what they remember in plain objects; to be called before the latter."""
    usual = state.fresh_state

    def fresh_state() -> Any:
        plain, record = Plain(state.LAYOUT), usual()
        for name in state.LAYOUT.names or ():
            plain[name] = record[name]
        return plain

    vars(zupt_filter)["fresh_state"] = fresh_state
    vars(memory).update(fresh=lambda kind: [Plain(kind)], packed=lambda settings: [settings])
