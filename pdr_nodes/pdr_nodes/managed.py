"""What every node is: managed, with a stage, inputs and outputs that it names in `set_up`.

configure: the parameters are read, the stage is made, the publishers stand. activate: samples are taken. deactivate:
nothing comes out; the stage keeps what it knows. cleanup: all is dropped, the next configure starts anew. Where
`node.autostart` is true (the default), the node walks to active by itself.
"""

from collections.abc import Callable
from contextlib import ExitStack
from typing import Any, ClassVar, Protocol

from rclpy.client import Client
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile

from pdr_core.params import Params
from pdr_core.records import Notice
from pdr_nodes.declare import read_params
from pdr_nodes.frames import prefixed
from pdr_nodes.idle import IdleWatch
from pdr_nodes.input import SAMPLES, Input, Words
from pdr_nodes.notice_board import NoticeBoard
from pdr_nodes.qos import OWN
from pdr_nodes.sole_output import SoleOutput
from pdr_nodes.timer import Timer

LOOK_S = 0.2  # how often to look whether the node is still wanted
DONE, FAILED = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE


class Part(Protocol):
    """What works only while the node is active."""

    def begin(self) -> None:
        """Work."""

    def end(self) -> None:
        """Work no more."""


class ManagedNode(LifecycleNode):
    """The base of all nodes."""

    NAME: ClassVar[str]
    GROUPS: ClassVar[tuple[str, ...]]  # of parameters

    def __init__(self) -> None:
        super().__init__(self.NAME, automatically_declare_parameters_from_overrides=True)
        self.problem: Exception | None = None  # why the last transition failed
        self._made = ExitStack()  # what cleanup undoes
        self._parts: list[Part] = []
        self._inputs: list[Input] = []
        self._sole_outputs: list[SoleOutput] = []
        self._idle: IdleWatch | None = None
        self._ends_with = ""  # a topic
        self._board = NoticeBoard(self, lambda: self.state, self._stream_notices)
        self._serve_change_state = self._service_change_state.callback
        self._service_change_state.callback = self._change_state_asked

    def set_up(self, params: Params) -> None:
        """Make the stage, the inputs and the outputs; an error is the reason why the node cannot be configured."""
        raise NotImplementedError

    def start(self) -> None:
        """Walk to active where `node.autostart` says so; raise what stands against it."""
        default = Parameter("node.autostart", value=Params().node.autostart)
        if self.get_parameter_or("node.autostart", default).value is False:
            return
        for transition in (self.trigger_configure, self.trigger_activate):
            if transition() != DONE:
                raise self.problem or RuntimeError(f"{self.NAME} cannot start")

    def work(self) -> float | None:
        """Do work of its own; return the time [s] until it wants to be called again, None when all is done."""
        return LOOK_S

    def take_leave(self) -> None:
        """Do what must be done before the process ends."""

    def destroy_node(self) -> None:
        """Leave the graph at once. The state machine, which rclpy 7.1 forgets, would stay until garbage is collected.

        Participants of one process may lock each other for good (Fast DDS 2.14).
        """
        super().destroy_node()
        del self._state_machine

    @property
    def waiting(self) -> int:
        """How many messages have come that the stage has not seen."""
        return sum(topic.waiting for topic in self._inputs)

    def take_waiting(self) -> None:
        """Let the stage see them."""
        for topic in self._inputs:
            topic.give()

    @property
    def state(self) -> str:
        """One of unconfigured, inactive, active, finalized."""
        return self._state_machine.current_state[1]

    # --- what a node says in `set_up`

    def input(
        self,
        kind: type,
        topic: str,
        block: Callable,
        take: Callable,
        qos: QoSProfile = OWN,
        restarts_anew: bool = False,
        words: Words = SAMPLES,
    ) -> None:
        """Give the messages of a topic to `take`, as one block those that wait; a `block` of None is left out.

        A publisher of ours that is started again says once more what was said, which is left out; a driver
        `restarts_anew`.
        """

        def fed(block: tuple) -> None:
            if self._idle:
                self._idle.fed()
            take(block)

        self._add_input(Input(self, kind, topic, qos, block, fed, restarts_anew, words))

    def side_input(
        self, kind: type, topic: str, block: Callable, take: Callable, qos: QoSProfile, words: Words
    ) -> None:
        """Give the messages of a driver's topic that comes beside the samples: alone, it does not keep a stream alive.

        Named before the samples, it is given before them.
        """
        self._add_input(Input(self, kind, topic, qos, block, take, restarts_anew=True, words=words))

    def _add_input(self, topic: Input) -> None:
        self._inputs.append(topic)
        self.part(topic)

    def output(self, kind: type, topic: str, qos: QoSProfile = OWN) -> Any:
        """Return a publisher that is silent unless the node is active."""
        publisher = self.create_lifecycle_publisher(kind, topic, qos)
        self._made.callback(self.destroy_lifecycle_publisher, publisher)
        return publisher

    def sole_output(self, kind: type, topic: str) -> SoleOutput:
        """Return a publisher of what only one node at a time may say; it exists only while the node is active."""
        self._sole_outputs.append(SoleOutput(self, kind, topic))
        self.part(self._sole_outputs[-1])
        return self._sole_outputs[-1]

    def service(self, kind: type, name: str, answer: Callable) -> None:
        """Answer a service."""
        self._made.callback(self.destroy_service, self.create_service(kind, name, answer))

    def client(self, kind: type, name: str) -> Client:
        """Return what calls a service."""
        client = self.create_client(kind, name)
        self._made.callback(self.destroy_client, client)
        return client

    def every(self, period_s: float, call: Callable[[], None]) -> None:
        """Call again and again."""
        self.part(Timer(self, period_s, call))

    def when_idle(self, after_s: float, finish: Callable[[], None]) -> None:
        """Call when samples have come and then none for a while: what waits for later ones can be given out."""
        self._idle = IdleWatch(after_s, finish, self._may_go_on)
        self.every(after_s / 4.0, self._idle.look)

    def tell(self, what: str, notices: Callable[[], list[Notice]]) -> None:
        """Put the notices of a stage on the board."""
        self._board.sources[what] = notices

    def part(self, part: Part) -> None:
        """Let something else work while the node is active."""
        self._parts.append(part)

    def _may_go_on(self) -> bool:
        return bool(self._ends_with) and self.count_publishers(self._ends_with) > 0

    def _stream_notices(self) -> list[Notice]:
        of_inputs = [notice for topic in self._inputs for notice in topic.notices]
        return of_inputs + [notice for topic in self._sole_outputs for notice in topic.notices]

    # --- the life of a managed node

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Read the parameters, make stage and publishers."""
        answer = self._tried(self._configure)
        if answer != DONE:
            self._drop_all()
            return answer
        return super().on_configure(state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Begin to take samples."""
        super().on_activate(state)
        answer = self._tried(self._begin_all)
        if answer != DONE:
            self.on_deactivate(state)
        return answer

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Take no more samples, say nothing more."""
        self._end_all()
        return super().on_deactivate(state)

    def on_cleanup(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Drop everything that `set_up` made."""
        self._drop_all()
        return DONE

    def on_shutdown(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Drop everything; the process ends then."""
        self._drop_all()
        return DONE

    def _configure(self) -> None:
        params = prefixed(read_params(self, self.GROUPS))
        self._ends_with = params.node.ends_with
        self.set_up(params)

    def _begin_all(self) -> None:
        for part in self._parts:
            part.begin()

    def _end_all(self) -> None:
        for part in reversed(self._parts):
            part.end()

    def _drop_all(self) -> None:
        self._end_all()
        self._parts, self._inputs, self._sole_outputs, self._idle = [], [], [], None
        self._board.sources.clear()
        self._made.close()

    def _tried(self, work: Callable[[], object]) -> TransitionCallbackReturn:
        """Do the work of a transition; an error, which rclpy would swallow, is kept as the reason of its failure."""
        self.problem = None
        try:
            work()
        except Exception as problem:
            self.problem = problem
            return FAILED
        return DONE

    def _change_state_asked(self, request: Any, response: Any) -> Any:
        """Answer the lifecycle service. What is impossible is refused; rclpy 7.1 would let it end the node."""
        self.problem = None
        try:
            response = self._serve_change_state(request, response)
        except RuntimeError:
            response.success = False
            self.problem = RuntimeError(f"this transition is not possible while the node is {self.state}")
        if self.problem:
            self.get_logger().error(str(self.problem))
        return response
