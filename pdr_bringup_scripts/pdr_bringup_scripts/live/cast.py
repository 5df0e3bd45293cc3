"""Which nodes a run has: those of every sensor, and one that answers the steps of feet and tells of the person."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from pdr_bringup_scripts.live.chain import ADAPTIVE, DRIVER, NODES, ON_CHEST, Chain
from pdr_bringup_scripts.live.chains import Chains
from pdr_bringup_scripts.live.listener import OF_A_FOOT, OF_A_PERSON, OF_A_SENSOR, OF_A_SWITCHED_FOOT, OF_ALL
from pdr_core.params import Params, changed, params_as_mapping

FUSION = "heading_fusion"
SAID = {NODES: OF_A_FOOT, ADAPTIVE: OF_A_FOOT | OF_A_SWITCHED_FOOT, ON_CHEST: OF_A_SENSOR}  # by the nodes of a sensor
OF_A_NODE = ("imu/data_raw", "imu/data", "stance", "odom")  # a topic of every node of a foot
LONGEST_ANSWER_S = 60.0
SILENT_S = 6.0
LEAD_SAMPLES = 60  # a few times as many as go to one decision
FOOT = "foot"  # the namespace of a foot alone whose steps are answered


@dataclass(frozen=True)
class Cast:
    """`feet`, or the chest, by their namespace below that of the run; `person` of None: nobody answers."""

    feet: Mapping[str, Params]  # "": its topics are in the namespace of the run itself
    person: Params | None = None
    nodes: tuple[str, ...] = NODES  # of each sensor

    @property
    def adaptive(self) -> bool:
        """The gyro of each foot is switched."""
        return self.nodes == ADAPTIVE

    @property
    def chest(self) -> bool:
        """The sensor is a card on the chest."""
        return self.nodes == ON_CHEST

    def with_params(self, change: Callable[[Params], Params]) -> "Cast":
        """Return the same nodes with parameters that are changed."""
        feet = {foot: change(params) for foot, params in self.feet.items()}
        return replace(self, feet=feet, person=change(self.person) if self.person else None)

    def that_begins_together(self, namespace: str) -> "Cast":
        """Return the same nodes, whose drivers wait for all others where several chains work together."""
        if not self.person and not self.adaptive:
            return self
        said = [below(foot, topic) for foot in self.feet for topic in OF_A_NODE]
        said += ["path"] if self.person else list(OF_A_SWITCHED_FOOT)
        awaited = " ".join(f"/{below(namespace, topic)}" for topic in said)
        feet = {foot: changed(params, "driver", begins_after=awaited) for foot, params in self.feet.items()}
        return replace(self, feet=feet)

    @property
    def topics(self) -> dict[str, str]:
        """What is said, by topic below the namespace of the run."""
        of_feet = {below(foot, topic): kind for foot in self.feet for topic, kind in SAID[self.nodes].items()}
        return of_feet | (OF_A_PERSON if self.person else {}) | OF_ALL

    def chains(
        self, logs: Path, namespace: str, driver: bool, remapped: Mapping[str, Mapping[str, str]] | None = None
    ) -> Chains:
        """Return the processes, not yet started. A driver that switches its gyro may be killed, to see what happens."""
        nodes = (*self.nodes, DRIVER) if driver else self.nodes
        kept = (DRIVER,) if self.adaptive else ()
        chains = [
            Chain(logs / foot, params_as_mapping(params), below(namespace, foot), nodes, remapped, kept)
            for foot, params in self.feet.items()
        ]
        if self.person:
            chains.append(Chain(logs / FUSION, params_as_mapping(self.person), namespace, (FUSION,)))
        return Chains(chains)


def below(namespace: str, name: str) -> str:
    """Return a name in a namespace; either may be empty."""
    return "/".join(part for part in (namespace, name) if part)


def one_foot(params: Params) -> Cast:
    """Return the nodes of a foot alone; where a heading constraint is on, it answers the steps."""
    if params.heading.constraint == "none":
        return Cast({"": params})
    return answered({FOOT: params})


def chest_card(params: Params) -> Cast:
    """Return the nodes of a card on the chest, which holds its heading by itself."""
    return Cast({"": params}, nodes=ON_CHEST)


def one_switched_foot(params: Params) -> Cast:
    """Return the nodes of a foot alone whose gyro is switched.

    The time within which the driver must answer is one by the wall clock, however fast the walk is played. On a busy
    machine the driver waits for the others: what it is asked then holds as soon as elsewhere; and a silence that is
    shorter than `SILENT_S` is that of the machine.
    """
    speed = max(1.0, params.driver.rate_factor)
    timeout_s = min(params.power.answer_timeout_s * speed, LONGEST_ANSWER_S)
    params = changed(params, "power", answer_timeout_s=timeout_s, silent_s=max(params.power.silent_s, SILENT_S))
    return Cast({"": changed(params, "driver", acknowledge_topic="walk", lead_samples=LEAD_SAMPLES)}, nodes=ADAPTIVE)


def both_simulated(params: Params, start_ns: int) -> Cast:
    """Return both simulated feet, whose first samples are stamped `start_ns`."""
    walk = changed(changed(params, "simulation", motion="smooth", start_ns=start_ns), "driver", device="simulated")
    return answered({foot: changed(walk, "simulation", foot=foot) for foot in ("left", "right")})


def answered(feet: Mapping[str, Params]) -> Cast:
    """Return the nodes of the feet of a person, each with a frame of its own, and of what answers their steps."""
    asking = {foot: changed(params, "filter", heading_feedback=True) for foot, params in feet.items()}
    framed = {foot: changed(params, "node", foot_frame=frame_of(foot)) for foot, params in asking.items()}
    return Cast(framed, changed(next(iter(asking.values())), "node", feet=" ".join(feet)))


def frame_of(foot: str) -> str:
    """Return what the frame of a foot is called."""
    return foot if foot == FOOT else f"{foot}_foot"
