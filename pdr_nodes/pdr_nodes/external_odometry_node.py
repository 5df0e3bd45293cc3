"""Node `external_odometry`: somebody else's odometry or position fixes beside ours, compared or as an aid.

`external.mode: compare` hears `odom` and changes nothing; points at which the person says to be lay it on a map so.
`external.mode: aid` takes the place of `heading_fusion` for the one foot or two that `node.feet` names: it answers
each step as that does, and by what the fixes say of the foot's place, and publishes the person's `odom`. The steps of
one foot have one who answers; so run one of the two.
"""

from typing import ClassVar

from nav_msgs.msg import Odometry

from pdr_core.external.map_points import compared_with
from pdr_core.parameter import ParameterError
from pdr_core.params import Params
from pdr_core.pipeline import AidedFusion
from pdr_nodes.convert import nav_block
from pdr_nodes.external_topics import ExternalTopics
from pdr_nodes.heading_fusion_node import HeadingFusionNode
from pdr_nodes.input import Words
from pdr_nodes.run import run

ESTIMATES = Words("estimates", question="is the chain running, and its namespace this node's?")


class ExternalOdometryNode(HeadingFusionNode):
    """Hosts the comparison with somebody else's odometry, or the fusion that it aids."""

    NAME = "external_odometry"
    PLACES = False  # their frame does
    GROUPS: ClassVar[tuple[str, ...]] = ("external", *HeadingFusionNode.GROUPS)

    def set_up(self, params: Params) -> None:
        """Take estimates and fixes; say how they compare, and in aid mode answer the steps."""
        if params.external.mode == "aid":
            super().set_up(params)
        else:
            self._compare(params)

    def make_fusion(self, params: Params, feet: tuple[str, ...]) -> AidedFusion:
        """Return what answers the steps, and let it hear the fixes; ParameterError if they cannot aid."""
        if params.external.known_points:
            raise ParameterError(
                "external.message = 'point': known points lay the track on a map: external.mode compare"
            )
        fusion = AidedFusion(params, feet)
        ExternalTopics(self, params, fusion.fixes, lambda: fusion.comparison)
        return fusion

    def _compare(self, params: Params) -> None:
        comparing = compared_with(params.external)
        ExternalTopics(self, params, comparing.take, lambda: comparing.comparison)
        self.input(Odometry, "odom", nav_block, comparing.add, words=ESTIMATES)
        self.tell("external", lambda: comparing.notices)


def main() -> None:
    """Run the node."""
    run(ExternalOdometryNode)


if __name__ == "__main__":
    main()
