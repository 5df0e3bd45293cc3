"""One clock for two feet: stamps that count from different moments, as from the start of a device and from 1970."""

from collections.abc import Sequence

from pdr_core.conventions import NO_STAMP


class Clocks:
    """By how much the stamps of each foot are shifted to those of the first one; 0 where the clocks agree."""

    def __init__(self, feet: Sequence[str], apart_ns: int) -> None:
        self._apart_ns = apart_ns
        self._first_ns = dict.fromkeys(feet, NO_STAMP)
        self._waited_for = set(feet)
        self.shift_ns = dict.fromkeys(feet, 0)

    @property
    def settled(self) -> bool:
        """Every foot has shown its clock, or is waited for no longer."""
        return not self._waited_for

    @property
    def awaited_ns(self) -> dict[str, int]:
        """The feet whose clocks are waited for, and the first stamp that waits for them."""
        seen_ns = [first_ns for first_ns in self._first_ns.values() if first_ns != NO_STAMP]
        return dict.fromkeys(self._waited_for, min(seen_ns)) if seen_ns else {}

    def see(self, foot: str, stamp_ns: int, now_ns: int) -> bool:
        """Note the first stamp of a foot; return whether its clock is another one, which is aligned then.

        `now_ns` is the latest stamp of the other foot, for one that comes late; NO_STAMP: it has none yet.
        """
        if self._first_ns[foot] != NO_STAMP:
            return False
        self._first_ns[foot] = stamp_ns
        self._waited_for.discard(foot)
        others = {name: first_ns for name, first_ns in self._first_ns.items() if name != foot and first_ns != NO_STAMP}
        for other, first_ns in others.items():
            apart_ns = (first_ns if now_ns == NO_STAMP else now_ns) - stamp_ns
            if abs(apart_ns) > self._apart_ns:
                moves_first = now_ns == NO_STAMP and foot == next(iter(self._first_ns))
                self.shift_ns[other if moves_first else foot] = -apart_ns if moves_first else apart_ns
                return True
        return False

    def leave(self, foot: str) -> None:
        """Wait for the clock of a foot no longer."""
        self._waited_for.discard(foot)
