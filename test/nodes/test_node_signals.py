import signal
from contextlib import ExitStack

import pytest
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState

from support.bench import Bench
from support.processes import NODES, node_process

SIGNALS = (signal.SIGINT, signal.SIGTERM)
READY = {  # what a node offers last
    "imu_driver": "set_sample_rate",
    "imu_ingestion": "imu/data_raw",
    "stance_detector": "imu/data",
    "zupt_ekf": "stance",
}


class Pair:
    """Each node twice, in namespaces of their own, to be ended by one signal each."""

    def __init__(self, stack, folder, when):
        self.bench = stack.enter_context(Bench())
        self.running = {}
        for name in NODES:
            for number in SIGNALS:
                space = f"{when}_{number.name}_{name}"
                log = folder / f"{space}.log"
                process = node_process(name, space, log, node__autostart=when != "inactive")
                self.running[name, number] = stack.enter_context(process), space, log

    def there(self, name, space):
        """The node has joined the graph."""
        return (name, f"/{space}") in self.bench.me.get_node_names_and_namespaces()

    def ready(self, name, space):
        """The node has said all it wants to say before its first sample."""
        topic = f"/{space}/{READY[name]}"
        if name == "imu_driver":
            return topic in dict(self.bench.me.get_service_names_and_types())
        return self.bench.me.count_subscribers(topic) == 1

    def inactive(self, name, space):
        """The node has been configured, and waits to be activated."""
        configure = Transition(id=Transition.TRANSITION_CONFIGURE)
        return self.bench.call(ChangeState, f"/{space}/{name}/change_state", transition=configure).success

    def end(self, moment):
        """Send each its signal at its moment; return how each ended and what it said."""
        for (name, number), (process, space, _) in self.running.items():
            self.bench.until(lambda n=name, s=space: moment(n, s), f"{name} to be up")
            process.send_signal(number)
        return {key: (process.wait(120), log.read_text()) for key, (process, _, log) in self.running.items()}


@pytest.mark.parametrize("when", ["there", "ready", "inactive"])
def test_a_signal_ends_a_node_in_peace(when, tmp_path):
    with ExitStack() as stack:
        pair = Pair(stack, tmp_path, when)
        ended = pair.end(getattr(pair, when))
    assert {key: code for key, (code, _) in ended.items() if code != 0} == {}
    assert {key: said for key, (_, said) in ended.items() if "Traceback" in said or "FATAL" in said} == {}
