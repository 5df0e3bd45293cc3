"""Which sensors of a recording are meant."""

from pdr_bringup_scripts.problems import Problem
from pdr_core.recording import Sensor, Session

SIDES = ("left", "right")


def chosen_sensors(session: Session, name: str | None) -> list[Sensor]:
    """Return the sensor that is asked for, or all."""
    if name is None:
        return list(session.sensors.values())
    if name not in session.sensors:
        raise Problem(f"{session.path} has no sensor {name!r}; choose from {', '.join(session.sensors)}")
    return [session.sensors[name]]


def only_sensor(session: Session, name: str | None) -> Sensor:
    """Return the sensor of that name, or the only one of a recording."""
    sensors = chosen_sensors(session, name or None)
    if len(sensors) > 1:
        raise Problem(f"{session.path} has several sensors; choose one by --sensor: {', '.join(session.sensors)}")
    return sensors[0]


def feet_of(session: Session, named: str | None) -> list[Sensor]:
    """Return the left and the right foot: as named, or the only two sensors if their names say so; else none."""
    if named is None:
        found = [[s for name, s in session.sensors.items() if side in name.lower()] for side in SIDES]
        sure = len(session.sensors) == len(SIDES) and all(len(sensors) == 1 for sensors in found)
        return [sensors[0] for sensors in found] if sure and found[0] != found[1] else []
    names = [name.strip() for name in named.split(",")]
    if len(names) != len(SIDES) or names[0] == names[1]:
        raise Problem(f"--feet {named}: name the left and the right foot, as --feet left_sensor,right_sensor")
    return [chosen_sensors(session, name)[0] for name in names]


def has_magnetometer(sensor: Sensor) -> bool:
    """Tell whether any sample has a magnetic field; read up to there."""
    return any((piece.field_sd_tesla >= 0.0).any() for piece in sensor.pieces())
