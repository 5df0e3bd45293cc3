"""The set-up behind `pdr`: what it decides, tried on made-up checkouts (nothing is installed)."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from bootstrap import python_packages, stamp, system_packages, tf2_msgs
from bootstrap.environment import launch_environment
from bootstrap.layout import Layout, this_checkout
from bootstrap.progress import Progress, SetupError
from bootstrap.ros import SourcedRos, sourced_prefix


def _file(path: Path, text: str = "") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def layout(tmp_path: Path) -> Layout:
    """A checkout whose environment looks finished."""
    made = Layout(tmp_path / "checkout")
    _file(made.messages / "msg" / "Step.msg", "float64 length\n")
    _file(made.bootstrap / "requirements-pdr.txt", "# ours\nnumpy==2.2.6\nscipy==1.15.3\n")
    _file(made.bootstrap / "requirements-build.txt", "ninja==1.13.2\n")
    _file(made.python)
    _file(made.venv / "lib" / "python3.11" / "site-packages" / "numpy" / "__init__.py")
    _finish(made, {})
    return made


def _finish(layout: Layout, environment: dict[str, str]) -> None:
    now = stamp.wanted(layout, environment)
    stamp.write_environment(layout, now, sourced=bool(now["ros"]))
    _file(layout.venv / "lib" / "libpdr_msgs__rosidl_generator_py.so")
    _file(layout.site_packages / "pdr_msgs" / "msg" / "__init__.py")
    stamp.write_messages(layout, now)


def _sourced(tmp_path: Path, distribution: str = "jazzy") -> dict[str, str]:
    prefix = tmp_path / "ros"
    _file(prefix / "lib" / "python3.12" / "site-packages" / "rclpy" / "__init__.py")
    return {"ROS_DISTRO": distribution, "AMENT_PREFIX_PATH": str(prefix)}


class TestStamp:
    def test_a_finished_environment_needs_nothing(self, layout: Layout) -> None:
        assert stamp.judge(layout, {}) == ("", "")

    def test_a_changed_message_rebuilds_the_messages_alone(self, layout: Layout) -> None:
        _file(layout.messages / "msg" / "Step.msg", "float32 length\n")
        assert stamp.judge(layout, {})[0] == stamp.MESSAGES

    def test_a_new_message_rebuilds_the_messages_alone(self, layout: Layout) -> None:
        _file(layout.messages / "srv" / "Reset.srv", "---\n")
        assert stamp.judge(layout, {})[0] == stamp.MESSAGES

    def test_a_missing_message_library_rebuilds_the_messages_alone(self, layout: Layout) -> None:
        (layout.venv / "lib" / "libpdr_msgs__rosidl_generator_py.so").unlink()
        assert stamp.judge(layout, {})[0] == stamp.MESSAGES

    def test_a_changed_requirement_makes_everything_anew(self, layout: Layout) -> None:
        _file(layout.bootstrap / "requirements-pdr.txt", "numpy==2.2.6\n")
        assert stamp.judge(layout, {}) == (stamp.EVERYTHING, stamp.REASONS["requirements"])

    def test_a_deleted_package_makes_everything_anew_and_is_named(self, layout: Layout) -> None:
        (layout.site_packages / "numpy" / "__init__.py").unlink()
        scope, reason = stamp.judge(layout, {})
        assert scope == stamp.EVERYTHING
        assert "numpy" in reason

    def test_a_missing_python_makes_everything_anew(self, layout: Layout) -> None:
        layout.python.unlink()
        assert stamp.judge(layout, {})[0] == stamp.EVERYTHING

    def test_a_python_that_became_another_one_makes_everything_anew(self, layout: Layout) -> None:
        layout.python.unlink()
        layout.python.symlink_to(_file(layout.checkout / "python3.12"))
        assert stamp.judge(layout, {})[0] == stamp.EVERYTHING

    def test_a_moved_checkout_makes_everything_anew(self, layout: Layout, tmp_path: Path) -> None:
        moved = Layout(layout.checkout.rename(tmp_path / "moved"))
        assert stamp.judge(moved, {}) == (stamp.EVERYTHING, stamp.REASONS["path"])

    @pytest.mark.parametrize("text", ["", "{", "[]"])
    def test_an_unreadable_stamp_counts_as_none(self, layout: Layout, text: str) -> None:
        layout.stamp.write_text(text, encoding="utf-8")
        assert stamp.judge(layout, {})[0] == stamp.EVERYTHING

    def test_a_set_up_killed_before_the_messages_goes_on_there(self, layout: Layout) -> None:
        stamp.write_environment(layout, stamp.wanted(layout, {}), sourced=False)
        assert stamp.judge(layout, {})[0] == stamp.MESSAGES

    def test_sourcing_a_ros_later_makes_everything_anew(self, layout: Layout, tmp_path: Path) -> None:
        environment = _sourced(tmp_path)
        assert stamp.judge(layout, environment) == (stamp.EVERYTHING, stamp.REASONS["ros"])


class TestRos:
    def test_a_sourced_jazzy_is_found(self, layout: Layout, tmp_path: Path) -> None:
        assert sourced_prefix(_sourced(tmp_path), layout) == str(tmp_path / "ros")

    def test_another_distribution_is_not_used(self, layout: Layout, tmp_path: Path) -> None:
        assert sourced_prefix(_sourced(tmp_path, "humble"), layout) == ""

    def test_a_sourced_ros_without_rclpy_is_not_used(self, layout: Layout, tmp_path: Path) -> None:
        environment = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": str(tmp_path / "none")}
        assert sourced_prefix(environment, layout) == ""

    def test_our_own_wheels_do_not_count_as_sourced(self, layout: Layout) -> None:
        _file(layout.site_packages / "rclpy" / "__init__.py")
        environment = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": str(layout.venv)}
        assert sourced_prefix(environment, layout) == ""

    def test_numpy_stays_at_the_version_of_the_sourced_ros(self, layout: Layout) -> None:
        ros = SourcedRos("/ros", "/usr/bin/python3", {"numpy": "1.26.4"})
        lines = python_packages.requirements(layout, ros, {"PATH": ""}).splitlines()
        assert lines == ["numpy==1.26.4", "scipy==1.15.3", "ninja==1.13.2"]

    @pytest.mark.parametrize("kind", ["ros", "build", "pdr"])
    def test_what_we_ask_for_is_in_the_full_list(self, kind: str) -> None:
        folder = this_checkout().bootstrap
        asked = (folder / f"requirements-{kind}.in").read_text(encoding="utf-8")
        listed = (folder / f"requirements-{kind}.txt").read_text(encoding="utf-8").lower()
        names = {re.sub(r"\[.*\]", "", line).lower() for line in asked.splitlines()}
        missing = {name for name in names if name[0] != "#"} - set(listed.splitlines())
        assert not missing


class TestTf2Fallback:
    def test_it_is_needed_where_nothing_brings_tf2_msgs(self, layout: Layout) -> None:
        assert not tf2_msgs.provided({}, layout)

    def test_it_is_not_needed_beside_a_real_one(self, layout: Layout, tmp_path: Path) -> None:
        _file(tmp_path / "ros" / "share" / "tf2_msgs" / "package.xml", "<package/>")
        assert tf2_msgs.provided({"AMENT_PREFIX_PATH": str(tmp_path / "ros")}, layout)

    def test_it_does_not_count_itself(self, layout: Layout) -> None:
        _file(layout.venv / "share" / "tf2_msgs" / "package.xml", tf2_msgs.PACKAGE)
        assert not tf2_msgs.provided({}, layout)

    def test_a_real_one_that_appears_later_rebuilds_the_messages(self, layout: Layout, tmp_path: Path) -> None:
        environment = _sourced(tmp_path)
        _finish(layout, environment)
        _file(tmp_path / "ros" / "share" / "tf2_msgs" / "package.xml", "<package/>")
        assert stamp.judge(layout, environment)[0] == stamp.MESSAGES


class TestSystemPackages:
    def test_a_missing_compiler_is_named_with_its_command(
        self, layout: Layout, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(os, "geteuid", lambda: 1000)
        progress = Progress(layout.log, lock=-1)
        with pytest.raises(SetupError, match=r"sudo apt-get install .*g\+\+"):
            system_packages.ensure(python_packages.base_python(), {"PATH": str(tmp_path)}, progress)

    def test_a_c_compiler_alone_is_not_enough(self, tmp_path: Path) -> None:
        _file(tmp_path / "cc").chmod(0o755)
        assert not system_packages.has_compiler({"PATH": str(tmp_path)})
        _file(tmp_path / "c++").chmod(0o755)
        assert system_packages.has_compiler({"PATH": str(tmp_path)})


STALE = {
    "AMENT_PREFIX_PATH": "/other/.venv",
    "LD_LIBRARY_PATH": "/other/.venv/lib",
    "PYTHONPATH": "/opt/ros/humble/lib/python3.10/site-packages",
    "PYTHONHOME": "/other",
    "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "another",
    "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp",
    "HOME": "/home/somebody",
}


class TestEnvironment:
    def test_stale_values_are_dropped_and_the_rest_is_kept(self, layout: Layout) -> None:
        environment = launch_environment(STALE, layout, sourced=False)
        assert environment["AMENT_PREFIX_PATH"] == str(layout.venv)
        assert environment["LD_LIBRARY_PATH"] == str(layout.venv / "lib")
        assert environment["RMW_IMPLEMENTATION"] == "rmw_fastrtps_cpp"
        assert not {"PYTHONPATH", "PYTHONHOME"} & set(environment)
        assert environment["HOME"] == "/home/somebody"

    def test_it_is_the_same_when_pdr_starts_pdr(self, layout: Layout) -> None:
        once = launch_environment({"PATH": "/usr/bin"}, layout, sourced=False)
        assert launch_environment(once, layout, sourced=False) == once

    def test_a_sourced_ros_stays_behind_ours(self, layout: Layout, tmp_path: Path) -> None:
        inherited = {**_sourced(tmp_path), "PYTHONPATH": "/ros/python"}
        environment = launch_environment(inherited, layout, sourced=True)
        expected = os.pathsep.join([str(layout.venv), str(tmp_path / "ros")])
        assert environment["AMENT_PREFIX_PATH"] == expected
        assert environment["PYTHONPATH"] == "/ros/python"

    def test_the_environment_of_another_checkout_is_dropped(self, layout: Layout, tmp_path: Path) -> None:
        other = _file(tmp_path / "other" / ".venv" / layout.stamp.name).parent
        inherited = {"AMENT_PREFIX_PATH": f"{other}:/ros", "PYTHONPATH": f"{other}/lib/x:/ros/x"}
        environment = launch_environment(inherited, layout, sourced=True)
        assert environment["AMENT_PREFIX_PATH"] == f"{layout.venv}:/ros"
        assert environment["PYTHONPATH"] == "/ros/x"
