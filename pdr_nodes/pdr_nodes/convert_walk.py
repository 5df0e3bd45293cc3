"""Between messages and records of what is seen of a walk."""

import math

from pdr_core.records_gait import Behaviour
from pdr_core.records_power import MeasuredStride as Stride
from pdr_core.records_power import Sensed, Walk
from pdr_msgs.msg import MeasuredStride, WalkStatus
from pdr_nodes.convert import stamp_ns, time_message

BEHAVIOURS = {behaviour.value: behaviour for behaviour in Behaviour}


def walk_message(walk: Walk, sensed: Sensed, foot_frame: str, forgotten: bool) -> WalkStatus:
    """Return what a piece of samples shows as a message; `forgotten`: the model was, before them."""
    message = WalkStatus()
    message.header.stamp = time_message(walk.stamp_ns)
    message.header.frame_id = foot_frame
    message.behaviour = walk.behaviour.value
    message.rest_tested, message.model_ready = walk.rest_tested, walk.model_ready
    message.model_forgotten, message.turn_suspected = forgotten, walk.turn_suspected
    message.strides = [stride_message(stride) for stride in walk.strides if math.isfinite(stride.filter_m)]
    message.reckoned = walk.reckoned
    message.gyro_measured, message.magnetometer, message.sample_rate = sensed
    return message


def walk_records(message: WalkStatus) -> tuple[Walk, Sensed]:
    """Return a message as what is seen of the walk, and of the driver; a behaviour that we do not know is unknown."""
    walk = Walk(
        stamp_ns(message.header.stamp),
        BEHAVIOURS.get(message.behaviour, Behaviour.UNKNOWN),
        message.rest_tested,
        message.model_ready,
        message.turn_suspected,
        tuple(map(measured_stride, message.strides)),
        message.reckoned,
    )
    return walk, Sensed(message.gyro_measured, message.magnetometer, message.sample_rate)


def stride_message(stride: Stride) -> MeasuredStride:
    """Return a stride as a message; without a model no number stands for its length."""
    message = MeasuredStride(start=time_message(stride.start_ns), end=time_message(stride.stamp_ns))
    message.measured_length = stride.filter_m
    if math.isfinite(stride.model_m) and stride.model_sd_m > 0.0:
        message.model_length, message.model_stddev = stride.model_m, stride.model_sd_m
    return message


def measured_stride(message: MeasuredStride) -> Stride:
    """Return a message as a stride."""
    model_m = message.model_length if message.model_stddev > 0.0 else math.nan
    start_ns, end_ns = stamp_ns(message.start), stamp_ns(message.end)
    return Stride(start_ns, end_ns, message.measured_length, model_m, message.model_stddev)
