"""One or two feet in, an answer to each of their steps and the body's way out.

The result does not depend on the order in which the feet's steps and odometry arrive. A step is taken in at the stamp
at which its answer is due, after all steps of either foot that are due earlier: both feet must have passed that stamp.
Live, steps and odometry come by different topics, in no order among each other. Still the odometry of a foot proves
which steps it has taken: a foot that waits for an answer gives out no estimate at or after the stamp at which that is
due, so an estimate at u proves that all its steps due up to u have been answered, and so have been received. And a foot
tells of a step before it waits for the answer: so no two feet wait for each other.

The body at t needs the estimates of both feet at t, and so all steps due up to t have been taken in; what they taught
counts from the stamp at which they were due.
"""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from pdr_core.conventions import NANOSECONDS, NO_STAMP, nanoseconds
from pdr_core.fusion import Watermark
from pdr_core.fusion.body import placed_m
from pdr_core.fusion.foot_rows import NEVER_NS, NO_ROWS, RESTART_NS, in_order, lost_yaws_ns, usable, worlds
from pdr_core.notices import Tally
from pdr_core.params import Params
from pdr_core.pipeline.body_track import BodyTrack
from pdr_core.pipeline.clocks import Clocks
from pdr_core.pipeline.foot_pair import FootPair, Places
from pdr_core.records import Floats, HeadingObservation, Level, NavBlock, Notice, StepEvent, joined, length, part

NO_NUMBER = "estimates of a foot hold NaN or infinity: left out"
CLOCK_BACK = "the clock of a foot has jumped back: the fusion of the feet begins anew"
CLOCKS_APART = "the clocks of the feet count from different moments: aligned by the stamps that came together"
NOT_ASKED = "a foot does not wait for its heading observations: set filter.heading_feedback"

TOGETHER_NS = 3 * NANOSECONDS  # who begins no later finds the other foot in its first rest


@dataclass(frozen=True)
class FusionOutput:
    """What became certain."""

    answers: list[tuple[str, HeadingObservation]]  # to the steps of the feet, one each
    body: NavBlock  # base_footprint in the world, the twist in its own frame


NOTHING = FusionOutput([], NO_ROWS)


@dataclass(frozen=True)
class Asked:
    """A step that waits for its answer, on the common clock; and on that of its foot, on which it is answered."""

    step: StepEvent
    own: StepEvent


class HeadingFusion:
    """Hosts the heading constraint of one foot, or the fusion of a left and a right one, named in this order."""

    def __init__(self, params: Params, feet: Sequence[str]) -> None:
        self._early: list[Callable[[], FusionOutput]] = []  # what came before all clocks were known
        self._steps: Watermark[Asked] = Watermark(feet)
        self._certain: deque[tuple[str, Asked]] = deque()
        self._own_ns = dict.fromkeys(feet, NO_STAMP)  # the last estimates, on the clock of the foot
        self._begin_clocks(feet, nanoseconds(params.fusion.clock_apart_s))
        self._last_rows: dict[str, NavBlock] = {}
        self._new_worlds: list[tuple[str, int]] = []  # feet that must be found, and since when
        self._pair = FootPair(params, feet)
        self._body = BodyTrack(feet, self._pair.frames, self._pair.gait)
        self._tally = Tally()

    def step(self, foot: str, event: StepEvent) -> FusionOutput:
        """Take a step of a foot."""
        return self._once_settled(partial(self._step, foot, event))

    def odometry(self, foot: str, nav: NavBlock) -> FusionOutput:
        """Take the next estimates of a foot, any number of them."""
        rows = usable(nav)
        if length(rows) < length(nav):
            lost = length(nav) - length(rows)
            self._tally.add("odometry_no_number", Level.WARN, NO_NUMBER, int(nav.stamp_ns[0]), lost)
        if not length(rows):
            return NOTHING
        return together([self._seen(foot, *piece) for piece in in_order(rows, self._own_ns[foot])])

    def leave(self, foot: str) -> FusionOutput:
        """Wait for a foot no longer, until it brings something again."""
        self._clocks.leave(foot)
        return self._once_settled(partial(self._leave, foot))

    def finish(self) -> FusionOutput:
        """Return all that waits: there will be no more."""
        last = [self.leave(foot) for foot in self._last_ns]
        return together([*last, self._output(self._steps.finish())])

    def placed_m(self, foot: str, position_m: Floats) -> Floats:
        """Return positions (n, 3) of a foot's world in that of the body, as it is known now."""
        return placed_m(self._pair.frame(foot), position_m)

    @property
    def awaited_ns(self) -> dict[str, int]:
        """The feet that hold something back, and the earliest stamp that waits for them."""
        by_what = (self._clocks.awaited_ns, self._steps.awaited_ns, self._body.awaited_ns, self._places_awaited_ns)
        feet = {foot for awaited_ns in by_what for foot in awaited_ns}
        return {foot: min(awaited_ns[foot] for awaited_ns in by_what if foot in awaited_ns) for foot in feet}

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._tally.notices + self._pair.notices

    @property
    def _places_awaited_ns(self) -> dict[str, int]:
        """The feet that have not told where they are as the next step to be answered ends, and that stamp."""
        return self._body.silent_at(self._certain[0][1].step.stamp_ns) if self._certain else {}

    def _seen(self, foot: str, clock_is_back: bool, rows: NavBlock) -> FusionOutput:
        """Take rows on a foot's own clock; where that has jumped back, all clocks are compared anew."""
        first_ns, last_ns = int(rows.stamp_ns[0]), int(rows.stamp_ns[-1])
        before = self._restart(foot, first_ns) if clock_is_back else NOTHING
        self._compare_clocks(foot, first_ns, self._last_ns)
        self._own_ns[foot] = last_ns
        return together([before, self._once_settled(partial(self._rows, foot, rows))])

    def _once_settled(self, work: Callable[[], FusionOutput]) -> FusionOutput:
        """Do the work, and what has waited before it, as soon as the clock of every foot is known."""
        self._early.append(work)
        if not self._clocks.settled:
            return NOTHING
        due, self._early = self._early, []
        return together([do() for do in due])

    def _step(self, foot: str, event: StepEvent) -> FusionOutput:
        if event.answer_due_ns == NO_STAMP:
            self._tally.add("heading_not_asked", Level.WARN, NOT_ASKED, event.stamp_ns)
            return NOTHING
        common = shifted(event, self._clocks.shift_ns[foot])
        return self._output(self._steps.put(foot, common.answer_due_ns, Asked(common, event)))

    def _rows(self, foot: str, own: NavBlock) -> FusionOutput:
        rows = own._replace(stamp_ns=own.stamp_ns + self._clocks.shift_ns[foot])
        if foot not in self._last_rows:
            self._first_ns[foot] = int(rows.stamp_ns[0])
            self._pair.begin(foot, rows.position_m[0])
            self._body.teach(self._first_ns[foot], self._pair.frames)
            self._doubt_late()
        self._new_worlds += [(foot, lost_ns) for lost_ns in lost_yaws_ns(rows, self._last_rows.get(foot))]
        for is_another_world, piece in worlds(rows, self._last_rows.get(foot)):
            if is_another_world:
                self._body.lose(foot, self._last_ns[foot])
                self._new_worlds.append((foot, int(piece.stamp_ns[0])))
            self._body.add(foot, piece)
            self._last_ns[foot] = int(piece.stamp_ns[-1])
            self._last_rows[foot] = part(piece, length(piece) - 1)
        return self._output(self._steps.advance(foot, self._last_ns[foot]))

    def _doubt_late(self) -> None:
        """Take it that nobody knows where a foot is that begins later than the other one, until it has made a step."""
        earliest_ns = min(self._first_ns.values())
        for foot, first_ns in self._first_ns.items():
            if first_ns > earliest_ns + TOGETHER_NS:
                self._body.lose(foot, first_ns - 1)
                self._new_worlds.append((foot, first_ns))

    def _found(self, foot: str, step: StepEvent, places: Places) -> bool:
        """Find a foot by its step; one that began before the other one walked is where it was taken to be."""
        first_ns = self._first_ns.get(foot, NO_STAMP)
        others_ns = min((ns for name, ns in self._walks_ns.items() if name != foot), default=NEVER_NS)
        stood = [ns for name, ns in self._new_worlds if name == foot] == [first_ns] and others_ns >= first_ns
        return stood or self._pair.begin_anew(foot, step, places)

    def _leave(self, foot: str) -> FusionOutput:
        self._body.leave(foot)
        return self._output(self._steps.leave(foot))

    def _restart(self, foot: str, stamp_ns: int) -> FusionOutput:
        """Begin anew: the clock of a foot has jumped back, to what the clock of the other one shows now."""
        self._tally.add("clock_jumped_back", Level.WARN, CLOCK_BACK, stamp_ns)
        last = self.finish()
        self._body.restart()
        self._begin_clocks(tuple(self._own_ns), RESTART_NS)
        for other in self._own_ns.keys() - {foot}:
            if self._own_ns[other] == NO_STAMP:
                self._clocks.leave(other)
            else:
                self._compare_clocks(other, self._own_ns[other], {})
        self._compare_clocks(foot, stamp_ns, self._own_ns)
        return last

    def _compare_clocks(self, foot: str, stamp_ns: int, latest_ns: Mapping[str, int]) -> None:
        """Compare the first stamp of a foot with the latest one of the other."""
        others_ns = max((ns for name, ns in latest_ns.items() if name != foot), default=NO_STAMP)
        if self._clocks.see(foot, stamp_ns, others_ns):
            self._tally.add("clocks_apart", Level.WARN, CLOCKS_APART, stamp_ns)

    def _begin_clocks(self, feet: Sequence[str], apart_ns: int) -> None:
        self._first_ns: dict[str, int] = {}  # of feet that came by these clocks
        self._walks_ns: dict[str, int] = {}  # since when
        self._clocks = Clocks(feet, apart_ns)
        self._last_ns = dict.fromkeys(feet, NO_STAMP)  # the last estimates, on the common clock

    def _output(self, certain: list[tuple[str, Asked]]) -> FusionOutput:
        """Answer the steps for which the places of both feet are known too, and go on with the body."""
        self._certain += certain
        answers = []
        while self._certain and self._body.known_until_ns >= self._certain[0][1].step.stamp_ns:
            answers.append(self._answered(*self._certain.popleft()))
        return FusionOutput(answers, self._body.run())

    def _answered(self, foot: str, asked: Asked) -> tuple[str, HeadingObservation]:
        step = asked.step
        places = partial(self._body.places, step.stamp_ns)
        worlds_ns = [start_ns for name, start_ns in self._new_worlds if name == foot and start_ns < step.stamp_ns]
        if worlds_ns and self._found(foot, step, places):
            self._new_worlds = [(name, ns) for name, ns in self._new_worlds if name != foot or ns not in worlds_ns]
            self._body.find(foot, step.answer_due_ns)
        self._walks_ns.setdefault(foot, step.start_ns)
        answer = self._pair.answer(foot, step, places)
        self._body.teach(step.answer_due_ns, self._pair.frames)
        return foot, replace(answer, step_ns=asked.own.stamp_ns, applies_from_ns=asked.own.answer_due_ns)


def shifted(step: StepEvent, shift_ns: int) -> StepEvent:
    """Return a step on another clock."""
    stamps = {name: getattr(step, name) + shift_ns for name in ("start_ns", "stamp_ns", "answer_due_ns")}
    return replace(step, **stamps)


def together(outputs: Sequence[FusionOutput]) -> FusionOutput:
    """Return several outputs as one."""
    bodies = [output.body for output in outputs if length(output.body)]
    return FusionOutput([a for output in outputs for a in output.answers], joined(bodies) if bodies else NO_ROWS)
