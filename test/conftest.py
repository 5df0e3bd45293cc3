"""What tests of every folder share: the real recordings and a ROS graph that nobody else is on."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

from pdr_bringup_scripts.live.chain import QUICK_DISCOVERY
from pdr_core.warmup import warm_up
from support.domain import own_domain
from support.participants import participants

CHECKOUT = Path(__file__).resolve().parents[1]

settings.register_profile("repeatable", deadline=None, derandomize=True)  # the time to compile is no failure
settings.load_profile("repeatable")


@pytest.fixture(scope="session")
def recordings() -> Path:
    """The folder of the real recordings; without it a test is skipped, or fails where they are required."""
    folder = Path(os.environ.get("PDR_RECORDINGS", CHECKOUT / "../shared/recordings"))
    if not folder.is_dir():
        if os.environ.get("PDR_REQUIRE_RECORDINGS") == "1":
            pytest.fail(f"PDR_REQUIRE_RECORDINGS is set but there is no folder {folder}")
        pytest.skip(f"the real recordings are not at {folder}; say where in PDR_RECORDINGS")
    return folder


@pytest.fixture(scope="session")
def ros_environment(tmp_path_factory):
    """A ROS domain of this session alone, on this machine alone; processes that a test starts inherit it."""
    with own_domain() as domain, pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_DOMAIN_ID", str(domain))
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        patch.setenv("FASTRTPS_DEFAULT_PROFILES_FILE", str(QUICK_DISCOVERY))
        patch.setenv("ROS_LOG_DIR", str(tmp_path_factory.mktemp("ros_log")))
        warm_up(both=True, adaptive=True)  # else nodes that a test starts compile, each for itself, within its deadline
        yield domain


@pytest.fixture(scope="module", autouse=True)
def _leaves_the_graph():
    """What a file of tests put on the ROS graph is gone with it, and not when garbage is collected."""
    before = participants()
    yield
    assert participants() <= before, "a test left its nodes to the garbage collector: destroy them where they are made"
