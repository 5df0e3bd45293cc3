"""Reads what the nodes of a foot whose gyro was switched have said back from a recording."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from pdr_bringup_scripts.live.cast import below
from pdr_bringup_scripts.live.live_recording import PIECE, messages, notices, timed_messages
from pdr_bringup_scripts.problems import Problem
from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.evaluation.saving import Saving
from pdr_core.pipeline import FootOutput
from pdr_core.records import Notice, joined
from pdr_core.records_power import Mode, ModeReport, Outcome
from pdr_nodes.convert import nav_block, stamp_ns, stance_block, step_event
from pdr_nodes.convert_mode import mode_report
from pdr_nodes.notice_board import NO_DRIVER

GYRO_OFF = "gyro_off"  # what the intake says of a gyro that was switched off
ENDED_NS = NANOSECONDS  # so long after the last sample, a fault says that there are no more
DRIVER = "driver_"  # begins what the mode manager says of it


def switched_outputs(bag: Path, foot: str) -> Iterator[FootOutput]:
    """Yield the estimates in pieces, each with the verdict that held at its stamp, and all steps with the first piece.

    While strides are reckoned, estimates have stamps of their own.
    """
    steps = [step_event(message) for message in messages(bag, below(foot, "step"))]
    pairs = held(messages(bag, below(foot, "stance")), messages(bag, below(foot, "odom")))
    while piece := list(islice(pairs, PIECE)):
        nav = joined([nav_block(odometry) for _, odometry in piece])
        judged = joined([stance_block(stance) for stance, _ in piece])
        yield FootOutput(judged._replace(imu=judged.imu._replace(stamp_ns=nav.stamp_ns)), nav, steps)
        steps = []


def held(verdicts: Iterator[Any], estimates: Iterator[Any]) -> Iterator[tuple[Any, Any]]:
    """Yield each estimate with the last verdict up to its stamp; where the clock jumps back, both follow."""
    verdict, following, before_ns = next(verdicts, None), next(verdicts, None), None
    for estimate in estimates:
        if verdict is None:
            raise Problem("there are estimates but no verdicts: messages were lost on the way")
        at_ns = stamp_ns(estimate.header.stamp)
        back = before_ns is not None and at_ns < before_ns
        while following and (back or stamp(verdict) <= stamp(following) <= at_ns):
            back = back and stamp(following) >= stamp(verdict)
            verdict, following = following, next(verdicts, None)
        before_ns = at_ns
        yield verdict, estimate


def stamp(verdict: Any) -> int:
    """Return the stamp of a verdict [ns]."""
    return stamp_ns(verdict.imu.header.stamp)


@dataclass(frozen=True)
class Decided:
    """What the mode manager has decided while there were samples."""

    reports: list[ModeReport]
    end_ns: int  # stamp of what it decided because they had ended; NO_STAMP: nothing

    @property
    def saving(self) -> Saving:
        """What was decided and answered, and what that has cost."""
        newest: list[ModeReport] = []  # of each command
        for report in self.reports:
            if newest and report.command == newest[-1].command:
                newest.pop()
            newest.append(report)
        commands = [report.command for report in newest if report.command]
        return Saving(self.reports[-1].energy, commands, [report.answer for report in newest])

    def concerns(self, notice: Notice) -> bool:
        """Tell whether a notice is of the walk: that the driver is gone after its last sample is not."""
        of_driver = notice.kind.startswith(DRIVER)
        return not (of_driver and self.end_ns != NO_STAMP and notice.first_stamp_ns >= self.end_ns)


def decided(bag: Path, foot: str) -> Decided:
    """Return what the mode manager has decided; Problem if that is nothing."""
    came = [(came_ns, mode_report(message)) for came_ns, message in timed_messages(bag, below(foot, "mode"))]
    last_ns = max((came_ns for came_ns, _ in timed_messages(bag, below(foot, "imu/data_raw"))), default=0)
    reports: list[ModeReport] = []
    for came_ns, report in came:
        if report.command is None:
            continue
        if came_ns > last_ns + ENDED_NS and is_fault(report):
            return Decided(checked(reports, bag), report.stamp_ns)
        reports.append(report)
    return Decided(checked(reports, bag), NO_STAMP)


def is_fault(report: ModeReport) -> bool:
    """Tell whether a report says that the driver is gone."""
    died = report.answer is not None and report.answer.outcome is Outcome.DIED
    return died or (report.command is not None and report.command.mode is Mode.FAULT)


def checked(reports: list[ModeReport], bag: Path) -> list[ModeReport]:
    """Return reports; Problem if there are none."""
    if not reports:
        raise Problem(f"{bag}: the mode manager has decided nothing: has the walk begun?")
    return reports


def switched_notices(bag: Path, of_walk: Decided, namespace: str) -> list[Notice]:
    """Return what was wrong in the walk; what the mode manager wants is not wrong."""
    found = [notice for notice in notices(bag, f"{namespace}/") if notice.kind not in (GYRO_OFF, NO_DRIVER)]
    return [notice for notice in found if of_walk.concerns(notice)]
