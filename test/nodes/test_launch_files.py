"""The launch files start the nodes they should. A stand-in takes the place of launch, which no package registry has."""

import runpy
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from pdr_core.parameter import grouped
from pdr_core.params import params_from_mapping

LAUNCH = Path(__file__).resolve().parents[2] / "pdr_bringup_scripts" / "launch"


class Record(SimpleNamespace):
    """What a launch file makes: the names of what it was given."""

    def __init__(self, *given, **named):
        super().__init__(given=given, **named)


class LaunchConfiguration:
    def __init__(self, name):
        self.name = name

    def perform(self, said):
        return said[self.name]


@pytest.fixture
def launched(monkeypatch):
    """Start a launch file with arguments and return its nodes, those of files that it includes too."""
    classes = dict.fromkeys(("LaunchDescription", "DeclareLaunchArgument", "OpaqueFunction", "Node"), Record)
    classes |= dict.fromkeys(("IncludeLaunchDescription", "PythonLaunchDescriptionSource"), Record)
    classes |= dict.fromkeys(("PathJoinSubstitution", "FindPackageShare"), Record)
    for name in ("", ".actions", ".substitutions", ".launch_description_sources"):
        for package in ("launch", "launch_ros"):
            module = ModuleType(package + name)
            module.__dict__.update(classes, LaunchConfiguration=LaunchConfiguration)
            monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.delitem(sys.modules, "pdr_bringup_scripts.launching", raising=False)

    def launch(file, arguments):
        *declared, function = runpy.run_path(str(file))["generate_launch_description"]().given[0]
        said = {argument.given[0]: argument.default_value for argument in declared}
        assert set(arguments) <= set(said)
        nodes = []
        for made in function.function(said | arguments):
            included = hasattr(made, "launch_arguments")
            nodes += launch(made.given[0].given[0], dict(made.launch_arguments)) if included else [made]
        return nodes

    return lambda file, **arguments: launch(LAUNCH / file, {"params": "foot.yaml"} | arguments)


def given(node):
    """The parameters that the launch file sets itself; each must be one of ours."""
    mapping = {name: value for part in node.parameters if isinstance(part, dict) for name, value in part.items()}
    return params_from_mapping(grouped(mapping))


def names(nodes):
    return sorted(f"{node.namespace}/{node.executable}".lstrip("/") for node in nodes)


CHAIN = ("imu_ingestion", "stance_detector", "zupt_ekf")


def test_two_feet_are_two_chains_and_a_person(launched):
    nodes = launched("two_feet.launch.py", left_imu="/l/imu", right_imu="/r/imu", right_mag="/r/mag", namespace="me")
    assert names(nodes) == sorted(
        [f"me/{foot}/{n}" for foot in ("left", "right") for n in CHAIN] + ["me/heading_fusion"]
    )
    for node in nodes:
        if node.executable == "heading_fusion":
            assert given(node).node.feet == "left right"
            continue
        side = node.namespace.removeprefix("me/")
        assert dict(node.remappings)["imu/data_raw"] == f"/{side[0]}/imu"
        assert given(node).node.foot_frame == f"{side}_foot"
        assert given(node).node.magnetometer is (side == "right")
        assert given(node).filter.heading_feedback


def test_one_foot_is_as_it_was(launched):
    nodes = launched("foot.launch.py", imu="/imu", foot_frame="sole")
    assert names(nodes) == sorted(CHAIN)
    assert {given(node).node.foot_frame for node in nodes} == {"sole"}
    assert not any(given(node).filter.heading_feedback for node in nodes)


def test_a_card_on_the_chest_needs_two_nodes(launched):
    nodes = launched("chest.launch.py", imu="/imu", mag="/mag", namespace="me", constraint="hde")
    assert names(nodes) == ["me/chest_pdr", "me/imu_ingestion"]
    assert {given(node).heading.constraint for node in nodes} == {"hde"}
    assert all(given(node).node.magnetometer for node in nodes)
    assert {dict(node.remappings)["imu/data_raw"] for node in nodes} == {"/imu"}


@pytest.mark.parametrize("file", ["two_feet.launch.py", "foot.launch.py", "chest.launch.py"])
def test_what_is_not_said_is_as_in_the_parameter_file(launched, file):
    for node in launched(file, params="mine.yaml"):
        said = {name for part in node.parameters if isinstance(part, dict) for name in part}
        assert not said & {"node.frame_prefix", "heading.constraint", "node.magnetometer"}
        assert node.parameters[0] == "mine.yaml"


@pytest.mark.parametrize("file", ["two_feet.launch.py", "foot.launch.py", "chest.launch.py"])
def test_the_frames_of_a_person_have_one_prefix(launched, file):
    constrained = {"constraint": "hde"} if file == "foot.launch.py" else {}
    nodes = launched(file, frame_prefix="alice/", **constrained)
    assert {"heading_fusion", "chest_pdr"} & {node.executable for node in nodes}
    assert {given(node).node.frame_prefix for node in nodes} == {"alice/"}


def test_one_foot_without_a_constraint_is_a_person_too(launched):
    nodes = launched("foot.launch.py", imu="/imu", constraint="none")
    (fusion,) = (node for node in nodes if node.executable == "heading_fusion")
    assert (given(fusion).node.feet, given(fusion).heading.constraint) == ("foot", "none")


def test_one_foot_whose_gyro_is_switched_has_a_navigator_and_a_manager(launched):
    nodes = launched("foot.launch.py", imu="/imu", adaptive="true", set_gyro_power="/imu/set_gyro_power")
    assert names(nodes) == sorted(("imu_ingestion", "stance_detector", "gait_dr", "mode_manager"))
    assert {dict(node.remappings)["set_gyro_power"] for node in nodes} == {"/imu/set_gyro_power"}
    assert {dict(node.remappings)["set_sample_rate"] for node in nodes} == {"set_sample_rate"}


@pytest.mark.parametrize("word", ["True", "1", " true "])
def test_true_is_true_however_it_is_written(launched, word):
    assert "mode_manager" in {node.executable for node in launched("foot.launch.py", adaptive=word)}


@pytest.mark.parametrize("name", ["adaptive", "heading_feedback"])
@pytest.mark.parametrize("word", ["yes", "ture", ""])
def test_what_is_neither_true_nor_false_is_refused(launched, name, word):
    with pytest.raises(RuntimeError, match=f"{name} is true or false"):
        launched("foot.launch.py", **{name: word})


def test_a_switched_gyro_does_not_go_with_a_second_foot(launched):
    with pytest.raises(RuntimeError, match="second foot"):
        launched("foot.launch.py", adaptive="true", heading_feedback="true")


def test_a_navigator_whose_gyro_is_switched_answers_its_steps_itself(launched):
    nodes = launched("foot.launch.py", adaptive="true", constraint="hde")
    assert names(nodes) == sorted(("imu_ingestion", "stance_detector", "gait_dr", "mode_manager"))
    (navigator,) = (node for node in nodes if node.executable == "gait_dr")
    assert given(navigator).heading.constraint == "hde"
    assert not given(navigator).filter.heading_feedback


def test_one_foot_with_a_constraint_has_somebody_who_answers(launched):
    nodes = launched("foot.launch.py", imu="/imu", constraint="hde")
    assert names(nodes) == sorted([f"foot/{n}" for n in CHAIN] + ["heading_fusion"])
    (fusion,) = (node for node in nodes if node.executable == "heading_fusion")
    assert (given(fusion).node.feet, given(fusion).heading.constraint) == ("foot", "hde")
    assert all(given(node).filter.heading_feedback for node in nodes if node is not fusion)
