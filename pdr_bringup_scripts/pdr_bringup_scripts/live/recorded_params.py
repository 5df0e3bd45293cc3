"""The parameters with which a recording was made, from the files that `pdr record` attaches."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

import yaml

from pdr_bringup_scripts.problems import Problem
from pdr_core.parameter import Groups
from pdr_core.params import Params, params_as_mapping, params_from_mapping
from pdr_core.params_file import load_params, ros_parameters
from pdr_core.recording import Sensor
from pdr_core.recording.mcap_salvage import mcap_attachments

PARAMETERS = "parameters.yaml"  # what is attached for each namespace
SENSOR = "imu"  # the last part of a sensor's name
OF_A_FOOT = "filter"  # the group that tells a foot's parameters
ITS_OWN = {"foot_frame", "sensor_frame", "feet"}  # of the group `node`: what differs between feet and changes no track


def chosen_params(file: Path | None, as_recorded: bool, recording: Path, sensors: Iterable[Sensor]) -> Params:
    """Return the parameters of a file, those with which the sensors were recorded, or the defaults."""
    if not as_recorded:
        return load_params(file) if file else Params()
    if file:
        raise Problem("--as-recorded takes the parameters of the recording: leave out --params")
    by_namespace = attached(recording)
    if not by_namespace:
        raise Problem(f"{recording} holds no parameters: only those of `pdr record` do; leave out --as-recorded")
    found = {sensor.name: of_sensor(by_namespace, sensor.name, recording) for sensor in sensors}
    first = next(iter(found))
    for sensor, params in found.items():
        if names := differing(found[first], params):
            text = f"{first} and {sensor} were recorded with different parameters ({', '.join(names)})"
            raise Problem(f"{text}: estimate one at a time, by --sensor")
    return found[first]


def attached(recording: Path) -> dict[str, Groups]:
    """Return what is attached as {namespace: {group: {name: value}}}."""
    files = [recording] if recording.is_file() else sorted(recording.glob("*.mcap"))
    found = {}
    for file in (file for file in files if file.suffix == ".mcap"):
        for name, data in mcap_attachments(file).items():
            namespace, _, last = name.rpartition("/")
            if last == PARAMETERS:
                found[namespace] = ros_parameters(file, yaml.safe_load(data))
    return found


def of_sensor(by_namespace: Mapping[str, Groups], sensor: str, recording: Path) -> Params:
    """Return the parameters of a foot, and of the person whose foot it is."""
    foot = sensor.removesuffix(SENSOR).strip("/")
    groups = by_namespace.get(foot, {})
    if OF_A_FOOT not in groups:
        raise Problem(f"{recording} holds no parameters for {sensor}: leave out --as-recorded")
    of_person = by_namespace.get(foot.rpartition("/")[0], {})  # heading_fusion is one level up
    return params_from_mapping({**of_person, **groups})


def differing(one: Params, other: Params) -> list[str]:
    """Return the names of what differs and changes a track."""
    one, other = (replace(params, driver=Params().driver, simulation=Params().simulation) for params in (one, other))
    both = params_as_mapping(one), params_as_mapping(other)
    names = [(group, name) for group, values in both[0].items() for name in values]
    changed = [(group, name) for group, name in names if both[0][group][name] != both[1][group][name]]
    return [f"{group}.{name}" for group, name in changed if not (group == "node" and name in ITS_OWN)]
