"""The body's way, row by row, as both feet tell it.

A row at t needs the rows of both feet up to t, and what the steps have taught up to t: what is learnt at a stamp counts
from there on, however much later the row is made. Rows have the stamps of the first foot; where that one has none, in
a gap or because it is lost, those of the other.
"""

from collections.abc import Sequence

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP
from pdr_core.fusion.body import Frame, Gait, Moved, between, moved
from pdr_core.fusion.foot_rows import NO_ROWS, FootRows, chosen, room
from pdr_core.records import NavBlock, Stamps, joined

NEVER_NS = 2**63 - 1
HISTORY_NS = 2 * NANOSECONDS  # of rows that are kept: a step is taken in some time after it was made


class BodyTrack:
    """Takes the rows of one or two feet and what is known of their frames; gives out what is certain of the body."""

    def __init__(self, feet: Sequence[str], frames: tuple[Frame, Frame], gait: Gait) -> None:
        self._feet = {foot: FootRows() for foot in feet}
        self._here = dict.fromkeys(feet, True)
        self._taught: list[tuple[int, tuple[Frame, Frame]]] = [(NO_STAMP, frames)]
        self._gait = gait
        self._done_ns = NO_STAMP

    def add(self, foot: str, rows: NavBlock) -> None:
        """Take later rows of a foot, which is here, then."""
        self._here[foot] = True
        self._feet[foot].add(rows)

    def lose(self, foot: str, after_ns: int) -> None:
        """Take it that nobody knows where a foot is after a stamp, until it is found."""
        self._feet[foot].lose(after_ns)

    def find(self, foot: str, from_ns: int) -> None:
        """Take it that the rows of a foot can be used again from a stamp on."""
        self._feet[foot].find(from_ns)

    def leave(self, foot: str) -> None:
        """Wait for a foot no longer."""
        self._here[foot] = False

    def teach(self, from_ns: int, frames: tuple[Frame, Frame]) -> None:
        """From a stamp on the feet are in these frames."""
        self._taught.append((max(from_ns, self._taught[-1][0]), frames))

    def restart(self) -> None:
        """Forget all rows: a clock has jumped back."""
        self._feet = {foot: FootRows() for foot in self._feet}
        self._taught, self._done_ns = [(NO_STAMP, self._taught[-1][1])], NO_STAMP

    def places(self, stamp_ns: int, frames: tuple[Frame, Frame]) -> list[Moved | None]:
        """Return where the feet are at a stamp, in the body's world; None: not known."""
        at = [rows.at(np.array([stamp_ns])) for rows in self._feet.values()]
        return [moved(nav, 0, frame) if known[0] else None for (nav, known), frame in zip(at, frames, strict=False)]

    @property
    def known_until_ns(self) -> int:
        """The stamp up to which every foot that is here has told where it was."""
        return min((self._feet[foot].last_ns for foot, is_here in self._here.items() if is_here), default=NEVER_NS)

    def run(self) -> NavBlock:
        """Return the rows that are certain now."""
        stamp_ns = self._stamps(self.known_until_ns)
        if not len(stamp_ns):
            return NO_ROWS
        pieces = [self._between(stamps, frames) for stamps, frames in self._by_frames(stamp_ns)]
        self._done_ns = int(stamp_ns[-1])
        for rows in self._feet.values():
            rows.forget(self._done_ns - HISTORY_NS)
        return joined(pieces)

    @property
    def awaited_ns(self) -> dict[str, int]:
        """The feet that hold rows back, and the earliest stamp that waits for them."""
        waiting = [
            int(stamps[0])
            for rows in self._feet.values()
            if len(stamps := rows.after(self._done_ns, rows.last_ns).stamp_ns)
        ]
        earliest_ns = min(waiting, default=NO_STAMP)
        return self.silent_at(earliest_ns)

    def silent_at(self, stamp_ns: int) -> dict[str, int]:
        """Return the feet that are here and have not told of a stamp yet, and it."""
        return {f: stamp_ns for f, rows in self._feet.items() if self._here[f] and rows.last_ns < stamp_ns}

    def _stamps(self, until_ns: int) -> Stamps:
        """Return the stamps of the first foot, and those of the other in its gaps."""
        of_first, *of_other = (rows.after(self._done_ns, until_ns).stamp_ns for rows in self._feet.values())
        for other in of_other:
            first = next(iter(self._feet.values())).rows.stamp_ns
            after = np.searchsorted(first, other)
            lone = np.ones(len(other), np.bool_)
            inner = (after > 0) & (after < len(first))
            lone[inner] = first[after[inner]] - first[after[inner] - 1] > GAP_NS
            lone &= ~np.isin(other, first)
            of_first = np.sort(np.concatenate([of_first, other[lone]]))
        return of_first

    def _by_frames(self, stamp_ns: Stamps) -> list[tuple[Stamps, tuple[Frame, Frame]]]:
        """Return the stamps in pieces, each with the frames that hold there; forget those that are over."""
        starts = np.searchsorted(stamp_ns, [from_ns for from_ns, _ in self._taught[1:]], side="left")
        pieces = np.split(stamp_ns, starts)
        held = [(piece, frames) for piece, (_, frames) in zip(pieces, self._taught, strict=True) if len(piece)]
        over = sum(from_ns <= stamp_ns[-1] for from_ns, _ in self._taught) - 1
        self._taught = self._taught[over:]
        return held

    def _between(self, stamp_ns: Stamps, frames: tuple[Frame, Frame]) -> NavBlock:
        at = [rows.at(stamp_ns) for rows in self._feet.values()]
        (left, left_known), (right, right_known) = at[0], at[-1]
        known = np.column_stack([left_known, right_known & (len(at) == 2)])
        out = room(len(stamp_ns))
        between(left, right, known, frames, self._gait, out)
        return chosen(out, known[:, 0] | known[:, 1])
