"""A recording whose gyro is switched and whose rate is lowered on the way."""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.maths.motion_switch import MotionRule
from pdr_core.power import GyroSwitch
from pdr_core.records import inertial_block, joined, length
from pdr_core.records_power import Mode, ModeCommand

RATE_HZ, SETTLE_S, SECONDS = 200.0, 0.05, 6.0
FULL_HZ = 1000.0
RULE = MotionRule(5.0, 2.0, 20.0, 60_000_000, 450_000_000, round(SETTLE_S * NANOSECONDS))


def recording(seed=3, start_ns=7_000_000_000):
    n = round(SECONDS * RATE_HZ)
    rng = np.random.default_rng(seed)
    stamps = start_ns + np.arange(n) * round(NANOSECONDS / RATE_HZ)
    return inertial_block(stamps, rng.normal(size=(n, 3)), rng.normal(size=(n, 3)), np.zeros(n), np.full(n, 0.1))


def command(number, gyro, rate_hz=FULL_HZ, not_before_ns=0, on_motion=False):
    return ModeCommand(number, not_before_ns, Mode.DEAD_RECKONING, "", gyro, rate_hz, not_before_ns, on_motion)


def strides(seconds=SECONDS, start_ns=7_000_000_000):
    """Return the force of a foot that stands, leaves, swings and strikes once a second, with a rate all the time."""
    t = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    phase, accel = t % 1.0, np.tile([0.0, 0.0, 9.81], (len(t), 1))
    swings = (phase > 0.4) & (phase < 0.9)
    accel[:, 0] += np.where(swings, 12.0 * np.sin(2.0 * np.pi * (phase - 0.4) / 0.5), 0.0)
    accel[:, 2] += np.where((phase >= 0.9) & (phase < 0.91), 40.0, 0.0)
    stamps = start_ns + np.arange(len(t)) * round(NANOSECONDS / RATE_HZ)
    rates = np.random.default_rng(1).normal(size=(len(t), 3))
    return inertial_block(stamps, rates, accel, np.zeros(len(t)), np.full(len(t), 0.1))


PLAN = {1.0: command(1, False, 50.0), 3.0: command(2, True), 4.0: command(3, False, 100.0), 5.5: command(4, True)}


def driven(pieces, plan=PLAN):
    """Return what the switch gives, and its answers; a command is given once its second is over."""
    switch, out, answers, plan = GyroSwitch(RULE), [], [], dict(plan)
    start_ns = int(pieces[0].stamp_ns[0])

    def take(given):
        for block in given:
            out.append(block)
            last_s = (int(block.stamp_ns[-1]) - start_ns) / NANOSECONDS if length(block) else 0.0
            for second in [s for s in plan if s <= last_s]:
                answers.append(switch.ask(plan.pop(second)))

    for piece in pieces:
        take(switch.run(piece))
    take(switch.finish())
    return joined(out), answers, switch
