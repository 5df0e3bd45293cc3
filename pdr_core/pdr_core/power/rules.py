"""Zhou's Tables 1-3 as one table: in each mode, the first rule that holds leads to the next mode.

Beyond the paper: a turn that is suspected wakes the gyro, because a heading without a gyro does not survive it; a gait
that comes back is not calibrated anew but examined; a person who stands gets the gyro off only where a model can reckon
the step that ends the rest. Where the sensor switches its gyro in each swing, all of that is needless.
"""

from collections.abc import Callable
from typing import NamedTuple

from pdr_core.power.memory import Memory
from pdr_core.records_power import Mode


class Rule(NamedTuple):
    """When a condition holds, a mode follows."""

    when: Callable[[Memory], bool]
    then: Mode
    why: str
    failed: bool = False  # the step length model has: it is calibrated anew, over the whole of L0


STANDS = Rule(lambda m: m.rests, Mode.STANDING, "the foot stands")
NEW = Rule(lambda m: m.new_behaviour, Mode.INITIALISING, "a behaviour without a calibrated step length model")
TURNS = Rule(lambda m: m.turns, Mode.SUSPICION, "a turn is suspected")

RULES: dict[Mode, tuple[Rule, ...]] = {
    Mode.INITIALISING: (
        STANDS,
        Rule(
            lambda m: m.walks and m.calibrated and not m.turns,
            Mode.DEAD_RECKONING,
            "L0 is walked and the step length model is good",
        ),
    ),
    Mode.DEAD_RECKONING: (
        STANDS,
        NEW,
        TURNS,
        Rule(lambda m: m.changed, Mode.EXAMINING, "a behaviour that was calibrated before"),
        Rule(lambda m: m.examination_due, Mode.EXAMINING, "T0 has passed since the last examination"),
    ),
    Mode.SWINGS: (NEW,),  # each stride is measured: there is nothing to examine
    Mode.EXAMINING: (
        STANDS,
        NEW,
        Rule(lambda m: m.misfits, Mode.INITIALISING, "the step length model does not fit any more", failed=True),
        Rule(lambda m: m.fits and m.turns, Mode.SUSPICION, "the step length model fits; a turn is suspected"),
        Rule(lambda m: m.fits, Mode.DEAD_RECKONING, "the step length model fits"),
    ),
    Mode.STANDING: (
        NEW,
        Rule(lambda m: m.moves, Mode.DEAD_RECKONING, "the foot moves again"),
    ),
    Mode.SUSPICION: (
        STANDS,
        NEW,
        Rule(lambda m: m.calm_again, Mode.DEAD_RECKONING, "no turn any more"),
    ),
    Mode.FAULT: (),  # it ends when the driver acknowledges
}
GYRO_ON = {Mode.INITIALISING, Mode.EXAMINING, Mode.SUSPICION, Mode.FAULT}


def next_mode(mode: Mode, memory: Memory) -> Rule | None:
    """Return the first rule that holds; None: the mode stays. Where the gyro is on in swings, nothing is reckoned."""
    rule = next((rule for rule in RULES[mode] if rule.when(memory)), None)
    if rule and rule.then is Mode.DEAD_RECKONING and memory.swings:
        return rule._replace(then=Mode.SWINGS)
    return rule
