"""Which sensors of a recording are played through the nodes, and through which."""

from collections.abc import Mapping

from pdr_bringup_scripts.live.cast import Cast, answered, one_foot
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.which_sensors import SIDES, feet_of, has_magnetometer, only_sensor
from pdr_core.params import Params, changed
from pdr_core.recording import Sensor, Session

ALONE = ""


def chosen_feet(session: Session, sensor: str, feet: str | None) -> dict[str, Sensor]:
    """Return the sensors of both feet by side, or the one that is asked for, or the only one, under no name."""
    if sensor and feet:
        raise Problem("--feet plays two feet: leave out --sensor")
    both = [] if sensor else feet_of(session, feet)
    return dict(zip(SIDES, both, strict=True)) if both else {ALONE: only_sensor(session, sensor)}


def replay_cast(params: Params, sources: Mapping[str, Sensor]) -> Cast:
    """Return the nodes that are fed by sensors of the recording that the parameters name."""
    feet = {}
    for foot, source in sources.items():
        played = changed(params, "driver", sensor=source.name)
        feet[foot] = changed(played, "node", magnetometer=has_magnetometer(source))
    return one_foot(feet[ALONE]) if ALONE in feet else answered(feet)
