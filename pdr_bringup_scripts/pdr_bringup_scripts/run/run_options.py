"""What `pdr run` is asked for, and which of its options go together."""

from dataclasses import dataclass
from pathlib import Path

from pdr_bringup_scripts.options import known_name
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.known_points import KnownPoint
from pdr_bringup_scripts.together import FOOT, PLACES, Alone, check_together
from pdr_core.evaluation.result import CAUSAL, CHEST, Hindsight
from pdr_core.params import Params, changed
from pdr_core.pipeline.stance_phases import OFFLINE, TIME_GATES, with_time_gate

WHOLE = ("--smooth", "--time-gate kmeans_offline")  # with these a run knows the whole recording beforehand
RULES = (
    Alone("--external", "goes with feet as they walk", ("--pipeline chest", "--adaptive", *WHOLE)),
    Alone("--at", "lays the track of feet on a map", ("--external", "--pipeline chest", "--adaptive", *WHOLE)),
    Alone("--pipeline chest", "knows one sensor, and nothing beforehand", ("--feet", "--adaptive", *WHOLE)),
    Alone("--pipeline chest", "looks for no standing foot", ("--detector", "--time-gate", "--level-ground")),
    Alone("--feet", "estimates two feet together as they walk", ("--sensor", "--adaptive", *WHOLE)),
    Alone("--adaptive", "decides on the way", WHOLE),
)


@dataclass(frozen=True)
class RunOptions:
    """The options of `pdr run` as they are typed; Problem if they do not go together."""

    out: Path | None = None  # where the files go; None: nowhere
    sensor: str | None = None
    feet: str | None = None
    detector: str | None = None
    time_gate: str | None = None
    level_ground: bool = False
    heading: str | None = None
    smooth: bool = False
    pipeline: str = FOOT
    adaptive: bool = False
    external: str = ""  # a topic; "": nobody else is asked
    aid: bool = False
    at: tuple[KnownPoint, ...] = ()  # where the person said to be

    def __post_init__(self) -> None:
        """Check names and combinations."""
        known_name("--pipeline", self.pipeline, PLACES)
        if self.time_gate is not None:
            known_name("--time-gate", self.time_gate, TIME_GATES)
        if self.aid and not self.external:
            raise Problem("--aid says what --external is for: give --external its topic")
        check_together(self._given(), RULES)

    def _given(self) -> set[str]:
        options = {
            "--sensor": self.sensor is not None,
            "--feet": self.feet is not None,
            "--detector": self.detector is not None,
            "--time-gate": self.time_gate is not None,
            "--level-ground": self.level_ground,
            "--smooth": self.smooth,
            "--time-gate kmeans_offline": self.time_gate == OFFLINE,
            "--pipeline chest": self.pipeline == CHEST,
            "--adaptive": self.adaptive,
            "--external": bool(self.external),
            "--at": bool(self.at),
        }
        return {option for option, is_given in options.items() if is_given}

    @property
    def hindsight(self) -> Hindsight:
        """What the run knows beforehand."""
        return Hindsight(self.smooth, self.time_gate == OFFLINE)

    @property
    def one_alone(self) -> bool:
        """Tell whether it is about one sensor, or two feet, to be named if there are several."""
        return self.beside or self.pipeline == CHEST

    @property
    def beside(self) -> bool:
        """Tell whether the track is laid beside what somebody else says, or the person."""
        return bool(self.external or self.at)

    @property
    def each_alone(self) -> bool:
        """Tell whether every sensor is estimated for itself, feet too: no two walk together as the options say."""
        named = self.sensor is not None or self.pipeline == CHEST
        return named or self.adaptive or self.hindsight != CAUSAL

    def applied_to(self, params: Params) -> Params:
        """Return the parameters with what the options say of them."""
        if self.detector is not None:
            params = changed(params, "stance", detector=self.detector)
        if self.time_gate is not None:
            params = with_time_gate(params, self.time_gate)
        if self.level_ground:
            params = changed(params, "filter", level_ground=True)
        if self.heading is not None:
            params = changed(params, "heading", constraint=self.heading)
        if self.at:
            return changed(params, "external", message="point", mode="compare")
        return changed(params, "external", mode="aid") if self.aid else params
