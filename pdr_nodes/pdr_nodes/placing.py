"""Somebody says where a track is now: topic `initialpose`, as RViz has a button for, or service `reset_estimate`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from geometry_msgs.msg import PoseWithCovariance, PoseWithCovarianceStamped

from pdr_core.notices import Tally
from pdr_core.records import Level, Notice, PoseEstimate
from pdr_msgs.srv import ResetEstimate
from pdr_nodes.convert import pose_estimate, stamp_ns
from pdr_nodes.hearing import Hearing
from pdr_nodes.managed import ManagedNode
from pdr_nodes.qos import ANSWERS

PLACED = "the track was placed by initialpose"
LEAST_VARIANCE = 1e-6  # [m^2, rad^2] RViz's button says 0 of the height; nobody knows it so well


class Placing:
    """Gives poses in the world frame to `place`, with whether biases are kept; others are left out, and said to be."""

    def __init__(self, node: ManagedNode, world_frame: str, place: Callable[[PoseEstimate, bool], None]) -> None:
        self._world, self._place = world_frame, place
        self._tally = Tally()
        node.part(Hearing(node, PoseWithCovarianceStamped, "initialpose", self._heard, ANSWERS))
        node.service(ResetEstimate, "reset_estimate", self._asked)

    @property
    def notices(self) -> list[Notice]:
        """What came of the topic."""
        return self._tally.notices

    def _heard(self, message: PoseWithCovarianceStamped) -> None:
        at_ns, frame = stamp_ns(message.header.stamp), message.header.frame_id
        if frame != self._world:
            way_out = f"set node.world_frame to it, or give it in {self._world!r}"
            text = f"initialpose is in frame {frame!r}: left out; {way_out}"
            self._tally.add("initialpose_frame", Level.WARN, text, at_ns)
            return
        try:
            self._place(told_pose(message.pose), True)
        except ValueError as error:
            self._tally.add("initialpose_unusable", Level.WARN, f"initialpose is left out: {error}", at_ns)
        else:
            self._tally.add("initialpose", Level.OK, PLACED, at_ns)

    def _asked(self, request: ResetEstimate.Request, response: ResetEstimate.Response) -> ResetEstimate.Response:
        try:
            self._place(told_pose(request.pose), request.keep_biases)
        except ValueError as error:
            response.success, response.message = False, str(error)
        else:
            response.success, response.message = True, "the estimate starts anew with the next sample"
        return response


def told_pose(message: PoseWithCovariance) -> PoseEstimate:
    """Return a message as a pose whose covariance is positive definite; ValueError if it is no pose."""
    pose = pose_estimate(message)
    covariance = pose.covariance + LEAST_VARIANCE * np.eye(6)
    if not np.allclose(covariance, covariance.T) or np.linalg.eigvalsh(covariance)[0] <= 0.0:
        raise ValueError("the covariance is none: it is not symmetric and positive")
    return replace(pose, covariance=covariance)
