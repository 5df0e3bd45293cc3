"""Several DDS participants in one process, as tests have them, come and go without locking each other."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

COME_AND_GO = """
import itertools, time
import rclpy
from std_msgs.msg import String

TOPICS = ("one", "two", "three")

def participant(name):
    context = rclpy.Context()
    rclpy.init(context=context)
    node = rclpy.create_node(name, context=context)
    for topic in TOPICS:
        node.create_subscription(String, topic, lambda message: None, 10)
    return context, node

others = [participant(f"node_{k}") for k in range(8)]
end = time.monotonic() + 4
for k in itertools.count():
    if time.monotonic() > end:
        break
    node = others[k % len(others)][1]
    publishers = [node.create_publisher(String, topic, 10) for topic in TOPICS]
    for publisher in publishers:
        publisher.publish(String(data="here"))
    for publisher in publishers:
        node.destroy_publisher(publisher)
    if k % 20 == 0:
        context, node = others.pop()
        node.destroy_node()
        context.try_shutdown()
        others.append(participant(f"node_again_{k}"))
print("came and went")
"""


@pytest.mark.usefixtures("ros_environment")
def test_endpoints_go_while_leases_run_out(tmp_path, monkeypatch):
    quick = Path(os.environ["FASTRTPS_DEFAULT_PROFILES_FILE"]).read_text()
    for patient, hasty in (("<sec>10</sec>", "<sec>0</sec><nanosec>40000000</nanosec>"), ("200000000", "20000000")):
        assert quick.count(patient) == 1, "the leases are written in another way now"
        quick = quick.replace(patient, hasty)
    profile = tmp_path / "hasty.xml"
    profile.write_text(quick)
    monkeypatch.setenv("FASTRTPS_DEFAULT_PROFILES_FILE", str(profile))
    said = subprocess.run([sys.executable, "-c", COME_AND_GO], capture_output=True, text=True, timeout=120)
    assert said.stdout == "came and went\n", said.stderr
