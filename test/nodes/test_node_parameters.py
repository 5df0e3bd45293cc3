import dataclasses

import pytest

from pdr_core.parameter import ParameterError, meta
from pdr_core.params import GROUPS
from pdr_nodes.gait_dr_node import GaitDrNode
from pdr_nodes.imu_driver_node import ImuDriverNode
from pdr_nodes.imu_ingestion_node import ImuIngestionNode
from pdr_nodes.mode_manager_node import ModeManagerNode
from pdr_nodes.stance_detector_node import StanceDetectorNode
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.processes import node_process, start

GROUPS_OF = {
    ImuDriverNode: ("driver", "simulation", "place", "power", "node"),
    ImuIngestionNode: ("intake", "node"),
    StanceDetectorNode: ("stance", "detectors", "place", "node"),
    ZuptEkfNode: ("filter", "place", "node"),
    GaitDrNode: ("filter", "place", "gait", "dead_reckoning", "power", "node"),
    ModeManagerNode: ("power", "node"),
}
REFUSED = {
    "an unknown name": (
        {"filter__gates": 1.0},
        r"filter.gates: unknown parameter, did you mean gate\? known are samples, .*gate",
    ),
    "an unknown group": (
        {"filtre__gate": 1.0},
        r"filtre: unknown group of parameters, did you mean filter\? known are .*filter",
    ),
    "no group": ({"gate": 1.0}, "gate = 1.0: parameters are group.name"),
    "out of bounds": ({"filter__gate": 0.5}, r"filter.gate = 0.5: must be float, within 1 .. 1e\+09"),
    "not a number": ({"stance__window_s": ".nan"}, "stance.window_s = '.nan': must be float, within 0 .. 1 s"),
    "a wrong type": ({"node__publish_tf": 1}, "node.publish_tf = 1: must be bool"),
    "a text": ({"node__idle_s": "soon"}, "node.idle_s = 'soon': must be float, within 0.2 .. 60 s"),
    "not a choice": ({"intake__accel_unit": "mg"}, r"intake.accel_unit = 'mg': must be str, one of m/s\^2, g"),
}
NODES = pytest.mark.parametrize("node", GROUPS_OF, ids=lambda n: n.__name__)


@NODES
@pytest.mark.parametrize("case", REFUSED)
def test_a_bad_parameter_is_named_with_value_and_bounds(node, case):
    given, words = REFUSED[case]
    with pytest.raises(ParameterError, match=words), Bench(node, **given):
        pass


@pytest.mark.parametrize(
    "name", ["imu_driver", "imu_ingestion", "stance_detector", "zupt_ekf", "gait_dr", "mode_manager"]
)
def test_a_bad_parameter_ends_the_process_with_one_sentence(name, tmp_path):
    with node_process(name, "parameters", tmp_path / "log", node__idle_s=100) as process:
        assert process.wait(60) == 2
    words = "pdr: node.idle_s = 100.0: must be float, within 0.2 .. 60 s\n"
    assert (tmp_path / "log").read_text() == words


def test_a_file_that_is_no_yaml_ends_the_process_with_one_sentence(tmp_path):
    (tmp_path / "mine.yaml").write_text("$ pdr params\n/**: [")
    command = ["-m", "pdr_nodes.zupt_ekf_node", "--ros-args", "--params-file", str(tmp_path / "mine.yaml")]
    process = start(command, tmp_path / "log")
    assert process.wait(60) == 2
    said = (tmp_path / "log").read_text()
    assert "Traceback" not in said
    assert "pdr: failed to initialize rcl: Couldn't parse params file" in said


@pytest.mark.parametrize("recording", ["", "/nowhere/walk.csv"])
def test_a_bad_recording_ends_the_driver_with_one_sentence(recording, tmp_path):
    given = {"driver__device": "replayed", "driver__recording": f"'{recording}'"}
    with node_process("imu_driver", "parameters", tmp_path / "log", **given) as process:
        assert process.wait(60) == 2
    said = (tmp_path / "log").read_text()
    assert said.startswith("pdr: ")
    assert said.count("\n") == 1
    assert (recording or "driver.recording is empty") in said


def test_an_integer_is_taken_for_a_float():
    with Bench(ZuptEkfNode, filter__gate=20) as bench:
        assert bench.node._filter._settings.gate == 20.0


def check_descriptor(shown, field):
    """Compare what ROS tools show of a parameter with what is declared in pdr_core."""
    known = meta(field)
    assert (shown.description, shown.additional_constraints) == (known.doc, known.allowed)
    assert shown.read_only
    ranges = [*shown.floating_point_range, *shown.integer_range]
    assert [(r.from_value, r.to_value) for r in ranges] == ([known.bounds] if known.bounds else [])


@NODES
def test_what_ros_tools_show_is_what_the_core_declares(node):
    with Bench(node) as bench:
        for group in GROUPS_OF[node]:
            for field in dataclasses.fields(GROUPS[group]):
                name = f"{group}.{field.name}"
                assert bench.node.get_parameter(name).value == field.default
                assert type(bench.node.get_parameter(name).value) is type(field.default)
                check_descriptor(bench.node.describe_parameter(name), field)


@NODES
def test_a_parameter_that_is_given_is_shown_like_the_others(node):
    given = {"node__idle_s": 2, "node__foot_frame": "l_sole"}
    fields = {f.name: f for f in dataclasses.fields(GROUPS["node"])}
    with Bench(node, **given) as bench:
        for name, value in (("idle_s", 2.0), ("foot_frame", "l_sole")):
            assert bench.node.get_parameter(f"node.{name}").value == value
            check_descriptor(bench.node.describe_parameter(f"node.{name}"), fields[name])
