"""What `external_odometry` hears from somebody else, and what it says of them."""

from collections.abc import Callable

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PointStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from pdr_core.conventions import NO_STAMP
from pdr_core.notices import Tally
from pdr_core.params import Params
from pdr_core.records import Level
from pdr_core.records_external import ExternalComparison, FixBlock
from pdr_nodes.convert import stamp_ns
from pdr_nodes.convert_external import External, comparison_message, fix_block, frame_message, frame_transform
from pdr_nodes.hearing import Hearing
from pdr_nodes.input import Words
from pdr_nodes.managed import ManagedNode
from pdr_nodes.qos import ANSWERS, FOREIGN_INPUT, LATEST, STATUS

KINDS = {"odometry": Odometry, "pose": PoseWithCovarianceStamped}
PERIOD_S = 1.0
NO_TF = "no transform from {!r} to {!r}, tf2 takes none: set external.map_frame or node.frame_prefix"
OTHER_FRAME = "fixes came in frame {!r} and now in {!r}, and are laid in one: remap `external` to one source"
WORDS = Words("fixes", "no_external", "incompatible_qos_external", "is it running, and external.message its kind?")


class ExternalTopics:
    """Fixes on `external` in; `external/frame`, `external/comparison` and perhaps the transform out, once a second."""

    def __init__(
        self,
        node: ManagedNode,
        params: Params,
        take: Callable[[FixBlock], None],
        compared: Callable[[], ExternalComparison],
    ) -> None:
        p = params.external
        self._node, self._compared, self._world = node, compared, params.node.world_frame
        self._named, self._their_frame = p.map_frame, p.map_frame
        self._heard_in: str | None = None  # the frame of the last fix
        self._at_ns = NO_STAMP  # of the last fix, their clock
        self._tally = Tally()
        node.tell("external_frames", lambda: self._tally.notices)
        if p.known_points:  # rare, so that silence is no fault
            node.part(Hearing(node, PointStamped, "external", lambda message: take(self._heard(message)), ANSWERS))
        else:
            node.side_input(KINDS[p.message], "external", self._heard, take, FOREIGN_INPUT, WORDS)
        self._frame = node.output(PoseWithCovarianceStamped, "external/frame", LATEST)
        self._comparison = node.output(DiagnosticArray, "external/comparison", STATUS)
        self._tf = node.output(TFMessage, "/tf_static", LATEST) if p.publish_tf else None
        node.every(PERIOD_S, self._say)

    def _heard(self, message: External) -> FixBlock:
        frame, self._at_ns = message.header.frame_id, stamp_ns(message.header.stamp)
        if self._heard_in not in (None, frame):
            self._tally.add("external_other_frame", Level.WARN, OTHER_FRAME.format(self._heard_in, frame), self._at_ns)
        self._heard_in, self._their_frame = frame, self._named or frame
        return fix_block(message)

    def _say(self) -> None:
        found = self._compared()
        if self._at_ns == NO_STAMP:
            return
        self._comparison.publish(comparison_message(found, self._at_ns, self._node.get_fully_qualified_name()[1:]))
        if found.frame:
            at_ns = self._at_ns - found.frame.clock_ns
            self._frame.publish(frame_message(found.frame, at_ns, self._their_frame))
            if self._tf and self._their_frame not in ("", self._world):
                transform = frame_transform(found.frame, at_ns, self._their_frame, self._world)
                self._tf.publish(TFMessage(transforms=[transform]))
            elif self._tf:
                text = NO_TF.format(self._their_frame, self._world)
                self._tally.once("external_no_tf", Level.WARN, text, at_ns)
