"""What the nodes have said on /diagnostics, read back for the result of a run."""

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.serialization import serialize_message

from pdr_bringup_scripts.live.listener import bag_writer
from pdr_bringup_scripts.live.live_recording import notices
from pdr_core.records import Level, Notice
from pdr_nodes.notice_board import status


def said(what, *kinds):
    """What a node of the namespace left says of something."""
    return status(f"left/imu_ingestion: {what}", [Notice(Level.WARN, kind, "", 1, 0) for kind in kinds], "")


def test_the_last_word_on_the_track_counts_and_the_end_of_the_samples_is_not_wrong(tmp_path):
    words = [
        [said("samples", "not_finite", "late_stamp"), said("orientation", "attitude_coasted")],
        [said("samples", "not_finite"), said("streams", "no_input", "no_field", "incompatible_qos")],
        [status("right/imu_ingestion: samples", [Notice(Level.WARN, "gyro_off", "", 1, 0)], "")],
    ]
    with bag_writer(tmp_path / "bag") as bag:
        for at_ns, statuses in enumerate(words):
            cdr = serialize_message(DiagnosticArray(status=statuses))
            bag.write("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", at_ns, cdr)
    assert [notice.kind for notice in notices(tmp_path / "bag", "left/")] == ["not_finite", "incompatible_qos"]
