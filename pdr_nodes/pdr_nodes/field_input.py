"""The magnetic field beside the samples: each sample is given on with its own, told by the stamps."""

from collections.abc import Callable

from sensor_msgs.msg import MagneticField

from pdr_core.conventions import nanoseconds
from pdr_core.field_pairing import FieldPairing
from pdr_core.params import NodeParams
from pdr_core.records import ImuBlock, Notice, length
from pdr_nodes.catch_up import CatchUp
from pdr_nodes.convert import FieldBlock, field_block
from pdr_nodes.input import Words
from pdr_nodes.managed import ManagedNode
from pdr_nodes.notice_board import NO_FIELD
from pdr_nodes.qos import driver_input

QUESTION = "is it published? Set node.magnetometer: false if the sensor has none."
WORDS = Words("field", NO_FIELD, "incompatible_field_qos", QUESTION)


class FieldInput:
    """Subscribes to `imu/mag`; `give` gets the samples whose field, or that they have none, is decided."""

    def __init__(self, node: ManagedNode, params: NodeParams, give: Callable[[ImuBlock], None]) -> None:
        wait_ns = nanoseconds(params.field_wait_s)
        self._pairing, self._start = FieldPairing(wait_ns), CatchUp(wait_ns)
        self._give = give
        qos = driver_input(params.input_reliable)
        node.side_input(MagneticField, "imu/mag", field_block, self._take_fields, qos, WORDS)
        node.part(self._start)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the fields so far."""
        return self._pairing.notices

    def take(self, raw: ImuBlock) -> None:
        """Take samples."""
        self._give_decided(self._pairing.run(self._start.run(raw)))

    def finish(self) -> None:
        """Give all samples that wait: no more comes."""
        self._give_decided(self._pairing.run(self._start.finish()))
        self._give_decided(self._pairing.finish())

    def _take_fields(self, fields: FieldBlock) -> None:
        self._pairing.take_field(*fields)
        self._start.heard(int(fields.stamp_ns[-1]))

    def _give_decided(self, samples: ImuBlock) -> None:
        if length(samples):
            self._give(samples)
