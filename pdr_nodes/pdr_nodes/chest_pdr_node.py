"""Node `chest_pdr`: samples of a card on the chest in (`imu/data`); `odom`, `step`, `filter_health` and perhaps tf out.

It hosts the pipeline that `pdr run --pipeline chest` runs. A rest is its zero-velocity update, and one of its steps a
step of the body. With a magnetometer the samples come with their field (`imu/marg`). Where `heading.constraint` says
so, the heading is held on straight lines, by the node itself. `initialpose` and `reset_estimate` put the track
elsewhere.
"""

from sensor_msgs.msg import Imu

from pdr_core.params import Params
from pdr_core.pipeline import ChestCard, FootOutput
from pdr_core.records import ImuBlock
from pdr_msgs.msg import MargSample
from pdr_nodes.convert import imu_block, marg_block
from pdr_nodes.managed import ManagedNode
from pdr_nodes.placing import Placing
from pdr_nodes.run import run
from pdr_nodes.track_output import TrackOutput


class ChestPdrNode(ManagedNode):
    """Hosts the pipeline of a card on the chest."""

    NAME = "chest_pdr"
    GROUPS = ("chest", "gait", "heading", "filter", "dead_reckoning", "place", "node")

    def set_up(self, params: Params) -> None:
        """Take samples, give estimates, steps and health; what waits, when no sample comes."""
        ChestCard(params).warm_up()
        self._card = ChestCard(params)
        self._track = TrackOutput(self, params.node, params.node.chest_frame, self._card)
        self._placing = Placing(self, params.node.world_frame, self._card.place)
        if params.node.magnetometer:
            self.input(MargSample, "imu/marg", marg_block, self._take)
        else:
            self.input(Imu, "imu/data", imu_block, self._take)
        self.when_idle(params.node.idle_s, lambda: self._publish(self._card.finish()))
        self.tell("track", lambda: self._card.notices + self._placing.notices)

    def _take(self, block: ImuBlock) -> None:
        self._publish(self._card.run(block))

    def _publish(self, output: FootOutput) -> None:
        self._track.estimates(output.nav)
        for step in output.steps:
            self._track.step(step)


def main() -> None:
    """Run the node."""
    run(ChestPdrNode)


if __name__ == "__main__":
    main()
