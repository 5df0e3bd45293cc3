"""What `pdr live` is asked for, which of its options go together, and which nodes that takes."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from pdr_bringup_scripts.live.cast import FOOT as ANSWERED
from pdr_bringup_scripts.live.cast import Cast, answered, below, chest_card, one_foot
from pdr_bringup_scripts.live.live_run import FEET_IDLE_S, FIELD_WAIT_S
from pdr_bringup_scripts.live.relay import INPUT, MAG_INPUT, DriverTopics
from pdr_bringup_scripts.options import known_name
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.which_sensors import SIDES
from pdr_bringup_scripts.together import FOOT, PLACES, Alone, check_together
from pdr_core.evaluation.result import CHEST
from pdr_core.params import Params, changed

NO_DRIVER, REPLAYED = "none", "replayed"
DEFAULT_IMU = "/imu/data_raw"
OUR_TOPICS = (INPUT, MAG_INPUT, "imu/data", "imu/marg")
TOPIC = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")
RULES = (
    Alone("--left", "is one of two feet", ("--imu", "--pipeline chest")),
    Alone("--left", "has its magnetometer on --left-mag, the other foot on --right-mag", ("--mag",)),
    Alone("--left", "needs drivers that run; `pdr demo --dual` and `pdr replay` start their own", ("--driver",)),
)


@dataclass(frozen=True)
class LiveOptions:
    """The options of `pdr live` as they are typed; Problem if they do not go together. A topic of "": not given."""

    imu: str = ""
    mag: str = ""
    left: str = ""
    right: str = ""
    left_mag: str = ""
    right_mag: str = ""
    driver: str = NO_DRIVER
    pipeline: str = FOOT

    def __post_init__(self) -> None:
        """Check names and combinations."""
        known_name("--pipeline", self.pipeline, PLACES)
        given = {option for option, topic in self._typed.items() if topic}
        given |= {"--driver"} if self.own_driver else set()
        given |= {"--pipeline chest"} if self.pipeline == CHEST else set()
        for one, other in (("--left", "--right"), ("--right", "--left")):
            if one in given and other not in given:
                raise Problem(f"{one} is one of two feet: give {other} its topic too; a foot alone is --imu")
            if f"{one}-mag" in given and one not in given:
                raise Problem(f"{one}-mag goes with --left and --right: the magnetometer of one sensor is --mag")
        check_together(given, RULES)

    @property
    def own_driver(self) -> bool:
        """A driver of ours is started with the nodes."""
        return self.driver != NO_DRIVER

    @property
    def _typed(self) -> dict[str, str]:
        feet = {"--left": self.left, "--left-mag": self.left_mag, "--right": self.right, "--right-mag": self.right_mag}
        return {"--imu": self.imu, "--mag": self.mag, **feet}

    @property
    def _pairs(self) -> list[tuple[str, str]]:
        """The options of each sensor and of its magnetometer."""
        return [(f"--{side}", f"--{side}-mag") for side in SIDES] if self.left else [("--imu", "--mag")]

    def topics(self, namespace: str) -> list[DriverTopics]:
        """Return where each sensor is heard; Problem for what is no topic, or is one twice."""
        names = {option: checked_topic(name, namespace) for option, name in self._wanted.items() if name}
        for option, name in names.items():
            if twice := [other for other, same in names.items() if same == name and other != option]:
                raise Problem(f"{name} cannot be both {option} and {twice[0]}: each has a topic of its own")
        return [DriverTopics(names[imu], names.get(mag, ""), self.own_driver) for imu, mag in self._pairs]

    @property
    def _wanted(self) -> dict[str, str]:
        return self._typed if self.left else self._typed | {"--imu": self.imu or DEFAULT_IMU}

    def cast(self, params: Params, topics: Sequence[DriverTopics]) -> Cast:
        """Return the nodes; Problem if the parameters ask for what the options do not give."""
        if params.node.magnetometer and (silent := [mag for _, mag in self._pairs if not self._typed[mag]]):
            raise Problem(
                f"node.magnetometer is true: say by {' and '.join(silent)} on which topic the magnetometer is"
            )
        heard = [self._heard(params, of_one) for of_one in topics]
        if self.left:
            return answered(dict(zip(SIDES, heard, strict=True)))
        return chest_card(*heard) if self.pipeline == CHEST else one_foot(*heard)

    def _heard(self, params: Params, topics: DriverTopics) -> Params:
        """Return the parameters of nodes that hear one sensor, by a relay of ours that loses nothing."""
        node = replace(params.node, input_reliable=True, autostart=True, magnetometer=bool(topics.mag))
        if self.left:
            node = replace(node, idle_s=max(node.idle_s, FEET_IDLE_S))
        if not self.own_driver:
            return replace(params, node=node)
        return self._driven(replace(params, node=replace(node, field_wait_s=FIELD_WAIT_S)))

    def _driven(self, params: Params) -> Params:
        """Return the parameters of a driver of ours; Problem if it has nothing to play."""
        params = changed(params, "driver", device=self.driver)
        if self.driver == REPLAYED and not params.driver.recording:
            text = "needs driver.recording in a file of --params, or use `pdr replay RECORDING`"
            raise Problem(f"--driver {REPLAYED} {text}")
        motion = {"motion": CHEST} if self.pipeline == CHEST else {}
        return changed(params, "simulation", magnetometer=params.node.magnetometer, **motion)


def checked_topic(name: str, namespace: str) -> str:
    """Return a topic from the root; Problem if it is none, or one on which our own nodes publish."""
    topic = "/" + name.strip("/")
    if not TOPIC.fullmatch(topic):
        raise Problem(f"{name!r} is no ROS topic; it looks like /foot/imu")
    if topic.removeprefix(f"/{namespace}/") in {
        below(foot, own) for foot in ("", ANSWERED, *SIDES) for own in OUR_TOPICS
    }:
        raise Problem(f"{topic} is a topic of our own nodes: choose another --namespace for them")
    return topic
