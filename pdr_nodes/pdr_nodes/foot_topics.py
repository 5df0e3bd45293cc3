"""What `heading_fusion` hears from one foot, and what it answers."""

import re
from collections.abc import Callable
from typing import Any

from nav_msgs.msg import Odometry

from pdr_core import records
from pdr_core.conventions import NO_STAMP
from pdr_core.notices import Tally
from pdr_core.parameter import ParameterError
from pdr_core.records import Level, NavBlock, Notice, empty_answer
from pdr_msgs.msg import HeadingObservation, StepEvent
from pdr_nodes.convert import nav_block, stamp_ns, step_event
from pdr_nodes.convert_feedback import heading_message
from pdr_nodes.hearing import Hearing
from pdr_nodes.held_output import HeldOutput
from pdr_nodes.input import Words
from pdr_nodes.managed import ManagedNode
from pdr_nodes.notice_board import NO_INPUT
from pdr_nodes.qos import ANSWERS, OWN

QUESTION = "is this foot's chain running? The person is followed by the other foot alone, if there is one."


def foot_names(feet: str) -> tuple[str, ...]:
    """Return the names in `node.feet`; ParameterError if they are not one or two different ones of ROS."""
    names = tuple(feet.split())
    legal = all(re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) for name in names)
    if not legal or len(set(names)) != len(names) or len(names) not in (1, 2):
        raise ParameterError(f"node.feet = {feet!r}: must be one or two different names, as left right")
    return names


class FootTopics:
    """Steps and estimates in, one heading observation out for every step; what is told in another frame is left out."""

    def __init__(
        self,
        node: ManagedNode,
        name: str,
        world_frame: str,
        step: Callable[[str, records.StepEvent], None],
        estimates: Callable[[str, NavBlock], None],
    ) -> None:
        self.frame = ""  # of the foot, as it says itself
        self._node, self._name, self._world, self._step = node, name, world_frame, step
        self._tally = Tally()
        words = Words("estimates", f"{NO_INPUT}_{name}", f"incompatible_qos_{name}", QUESTION)
        node.input(Odometry, f"{name}/odom", self._estimate, lambda nav: estimates(name, nav), words=words)
        node.part(Hearing(node, StepEvent, f"{name}/step", self._stepped, OWN))
        self._answers = HeldOutput(node, HeadingObservation, f"{name}/heading_observation", ANSWERS)

    @property
    def notices(self) -> list[Notice]:
        """What was left out."""
        return self._tally.notices

    @property
    def has_ended(self) -> bool:
        """The foot was heard, and now nobody is there who tells of it."""
        return bool(self.frame) and not self._node.count_publishers(f"{self._name}/odom")

    def answer(self, observation: records.HeadingObservation) -> None:
        """Answer a step."""
        self._answers.publish(heading_message(observation, self.frame))

    def _estimate(self, odometry: Odometry) -> NavBlock | None:
        return nav_block(odometry) if self._in_our_world(odometry) else None

    def _stepped(self, message: StepEvent) -> None:
        step = step_event(message)
        if self._in_our_world(message):
            self._step(self._name, step)
        elif step.answer_due_ns != NO_STAMP:
            self.answer(empty_answer(step))

    def _in_our_world(self, message: Any) -> bool:
        self.frame = message.child_frame_id
        given = message.header.frame_id
        if given == self._world:
            return True
        text = f"{self._name} is told in frame {given!r}, not {self._world!r} (node.world_frame): left out"
        self._tally.add(f"wrong_frame_{self._name}", Level.WARN, text, stamp_ns(message.header.stamp))
        return False
