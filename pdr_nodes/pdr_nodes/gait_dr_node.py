"""Node `gait_dr`: samples with verdicts in (`stance`); `odom`, `step`, `filter_health`, `walk` and perhaps tf out.

It stands in the place of `zupt_ekf`: the filter while the gyro is on, dead reckoning by strides while it is off. What
`walk` says the mode manager decides by; of what that says (`mode`) only a failed step length model matters here. The
heading constraint, if one is wanted, answers its steps within it. `initialpose` and `reset_estimate` put the track
elsewhere.
"""

from pdr_core.params import Params
from pdr_core.pipeline import AdaptiveFoot, FootOutput
from pdr_core.records import StanceBlock
from pdr_core.warmup import warm_up
from pdr_msgs.msg import NavigationMode, StanceImu, WalkStatus
from pdr_nodes.convert import stance_block
from pdr_nodes.convert_walk import walk_message
from pdr_nodes.hearing import Hearing
from pdr_nodes.managed import ManagedNode
from pdr_nodes.placing import Placing
from pdr_nodes.qos import ANSWERS, MODES
from pdr_nodes.run import run
from pdr_nodes.track_output import TrackOutput


class GaitDrNode(ManagedNode):
    """Hosts the navigation of one foot whose gyro is switched."""

    NAME = "gait_dr"
    GROUPS = ("filter", "stance", "detectors", "place", "gait", "dead_reckoning", "heading", "power", "node")

    def set_up(self, params: Params) -> None:
        """Take verdicts, give estimates, steps, health and what is seen of the walk."""
        warm_up(params, adaptive=True)
        self._foot = AdaptiveFoot(params)
        self._failed = 0  # the newest command whose step length model has
        self._forgotten = False  # since the last piece
        self._track = TrackOutput(self, params.node, params.node.foot_frame, self._foot)
        self._placing = Placing(self, params.node.world_frame, self._foot.place)
        self._walk = self.output(WalkStatus, "walk", ANSWERS)
        self.part(Hearing(self, NavigationMode, "mode", self._told, MODES))
        self.input(StanceImu, "stance", stance_block, self._take)
        # twice the time after which the stance detector gives out its last samples, so that none comes after the step
        self.when_idle(2.0 * params.node.idle_s, lambda: self._publish(self._foot.finish()))
        self.tell("track", lambda: self._foot.notices + self._placing.notices)

    def _take(self, block: StanceBlock) -> None:
        for moved in self._foot.run(block):
            self._publish(moved.output)
            self._walk.publish(walk_message(moved.walk, moved.sensed, self._track.frames[1], self._forgotten))
            self._forgotten = False

    def _told(self, message: NavigationMode) -> None:
        """Forget a model that has failed, once, from the next piece of samples on."""
        if message.step_model_failed and message.command != self._failed:
            self._foot.forget_length()
            self._forgotten = True
        self._failed = message.command if message.step_model_failed else 0

    def _publish(self, output: FootOutput) -> None:
        self._track.estimates(output.nav)
        for step in output.steps:
            self._track.step(step)


def main() -> None:
    """Run the node."""
    run(GaitDrNode)


if __name__ == "__main__":
    main()
