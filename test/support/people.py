"""Two people with a sensor on each foot, through running nodes on one graph, as a robot beside them hears it."""

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

from nav_msgs.msg import Odometry
from nav_msgs.msg import Path as Way
from rclpy.duration import Duration
from sensor_msgs.msg import Imu
from tf2_msgs.msg import TFMessage

from pdr_bringup_scripts.live.cast import Cast, answered
from pdr_bringup_scripts.live.live_run import for_one_run
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import BothFeet, BothOutput
from pdr_core.rate_limit import RateLimit
from pdr_core.records import ImuBlock, NavBlock, joined, length
from pdr_core.simulation import simulated_feet
from pdr_nodes.qos import LATEST
from support.bench import Bench
from support.feet import FEET
from support.walks import BEGIN_NS, imu_messages

WALKS = {"alice": ("rectangle", 0.0), "bob": ("straight", 2.0)}  # the walk and the yaw at its start
WITHIN_S = 120.0
PATIENT_S = 20.0  # a busy machine is no node that has ended


def params_of(person: str) -> Params:
    """Return how the nodes of a person are set: her frames are told from those of others by her name."""
    turned = changed(Params(), "filter", initial_yaw_rad=WALKS[person][1])
    return changed(turned, "node", frame_prefix=f"{person}/", answer_timeout_s=PATIENT_S)


def walk_of(person: str) -> dict[str, ImuBlock]:
    """Return what the sensors of both feet measure."""
    walk = SimulationParams(motion="smooth", walk=WALKS[person][0], walk_length_m=6.0, sample_rate_hz=100.0)
    return {foot: both.imu for foot, both in simulated_feet(walk, start_ns=BEGIN_NS).items()}


def offline(person: str) -> dict[str, NavBlock]:
    """Return what is made of the walk without nodes: of each foot, and of the body under no name."""
    both, walk = BothFeet(params_of(person), FEET), walk_of(person)
    outputs: list[BothOutput] = [both.run(foot, walk[foot]) for foot in FEET] + [both.finish()]
    limit = {foot: RateLimit(Params().node.odom_rate_hz) for foot in FEET}
    navs = {foot: [nav.nav for output in outputs for name, nav in output.feet if name == foot] for foot in FEET}
    feet = {f"/{foot}": limit[foot].thinned(joined(navs[foot])) for foot in FEET}
    return feet | {"": joined([output.body for output in outputs if length(output.body)])}


def cast_of(person: str) -> Cast:
    """Return the nodes of a person."""
    return answered(dict.fromkeys(FEET, params_of(person))).with_params(for_one_run)


class People:
    """Runs the nodes, publishes the samples of all feet, and keeps what is said."""

    def __init__(self, folder: Path, expected: Mapping[str, Mapping[str, NavBlock]]) -> None:
        addresses = [f"/{person}{foot}" for person in WALKS for foot in expected[person]]
        with ExitStack() as stack:
            for person in WALKS:
                stack.enter_context(cast_of(person).chains(folder / person, person, driver=False))
            bench = stack.enter_context(Bench())
            self.odometry = {address: bench.hear(Odometry, f"{address}/odom") for address in addresses}
            self.paths = {person: bench.hear(Way, f"/{person}/path", LATEST) for person in WALKS}
            self.transforms = bench.hear(TFMessage, "/tf", 10_000)
            inputs = {
                (person, foot): bench.publisher(Imu, f"/{person}/{foot}/imu/data_raw")
                for person in WALKS
                for foot in FEET
            }
            bench.until(lambda: bench.me.count_publishers("/bob/path"), "the nodes of a person")
            for (person, foot), publisher in inputs.items():
                bench.feed(publisher, imu_messages(walk_of(person)[foot]))
            for publisher in inputs.values():  # as a driver does that has told all
                publisher.wait_for_all_acked(Duration(seconds=10))
                bench.me.destroy_publisher(publisher)
            wanted = {f"/{person}{foot}": length(nav) for person in WALKS for foot, nav in expected[person].items()}
            bench.until(lambda: not self._missing(wanted), "all estimates", WITHIN_S)
            self.publishers = {a: bench.me.count_publishers(f"{a}/odom") for a in addresses}
            self.broadcasters = bench.me.count_publishers("/tf")

    def _missing(self, wanted: Mapping[str, int]) -> list[str]:
        return [address for address, count in wanted.items() if len(self.odometry[address]) < count]

    @property
    def single(self) -> list:
        """Every transform."""
        return [transform for message in self.transforms for transform in message.transforms]
