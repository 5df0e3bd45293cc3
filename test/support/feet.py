"""Both feet of a simulated walk at work on topics: each waits for its answers as a filter's node does."""

from collections.abc import Mapping

from nav_msgs.msg import Odometry

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import BothFeet, FootInertial, FootOutput
from pdr_core.records import HeadingObservation, ImuBlock, NavBlock, StepEvent, joined, length, part
from pdr_core.simulation import simulated_feet
from pdr_msgs.msg import HeadingObservation as HeadingMessage
from pdr_msgs.msg import StepEvent as StepMessage
from pdr_nodes.convert import odometry_message, step_message
from pdr_nodes.convert_feedback import heading_observation
from pdr_nodes.qos import ANSWERS
from support.bench import Bench
from support.walks import BEGIN_NS

ASKING = changed(Params(), "filter", heading_feedback=True)
FEET = ("left", "right")


def both_walk(length_m: float, rate_hz: float = 100.0) -> dict[str, ImuBlock]:
    """Return what the sensors of both feet measure on a straight walk."""
    params = SimulationParams(walk="straight", walk_length_m=length_m, sample_rate_hz=rate_hz)
    return {foot: walk.imu for foot, walk in simulated_feet(params, start_ns=BEGIN_NS).items()}


def offline_body(walk: Mapping[str, ImuBlock], params: Params = ASKING) -> NavBlock:
    """Return what is made of both feet offline."""
    both = BothFeet(params, FEET)
    outputs = [both.run(foot, walk[foot]) for foot in FEET] + [both.finish()]
    return joined([output.body for output in outputs if length(output.body)])


class FootOnTopics:
    """Takes samples, publishes `odom` and `step`, and goes on where it has waited when the answer comes."""

    def __init__(self, bench: Bench, name: str, params: Params = ASKING, world_frame: str = "odom") -> None:
        self.name, self.frames = name, (world_frame, f"{name}_foot")
        self.chain = FootInertial(params, heading=None)
        self.answers: list[HeadingObservation] = []
        self.steps: list[StepEvent] = []
        self.latest_ns = 0
        self._odom = bench.publisher(Odometry, f"{name}/odom")
        self._step = bench.publisher(StepMessage, f"{name}/step")
        self._bench = bench
        self.listen()

    def listen(self) -> None:
        """Hear the answers from now on."""
        topic = f"{self.name}/heading_observation"
        self.hears = self._bench.me.create_subscription(HeadingMessage, topic, self._answered, ANSWERS)

    def leave(self) -> None:
        """Go in order, as a node does that has ended."""
        for publisher in (self._odom, self._step):
            self._bench.me.destroy_publisher(publisher)

    def walk(self, samples: ImuBlock) -> None:
        """Take samples."""
        self.tell(self.chain.run(samples))

    def end(self) -> None:
        """There are no more."""
        self.tell(self.chain.finish())

    def tell(self, output: FootOutput) -> None:
        """Publish what has become known."""
        for step in output.steps:
            self.steps.append(step)
            self._step.publish(step_message(step, *self.frames))
        for i in range(length(output.nav)):
            self._odom.publish(odometry_message(output.nav, i, *self.frames))
            self.latest_ns = int(output.nav.stamp_ns[i])

    def _answered(self, message: HeadingMessage) -> None:
        self.answers.append(heading_observation(message))
        self.tell(self.chain.answer(self.answers[-1]))


def halves(samples: ImuBlock) -> tuple[ImuBlock, ImuBlock]:
    """Return samples in two parts."""
    middle = length(samples) // 2
    return part(samples, 0, middle), part(samples, middle)
