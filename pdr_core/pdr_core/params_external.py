"""The parameters of what somebody else knows of the person's place."""

from dataclasses import dataclass

from pdr_core.parameter import parameter


@dataclass(frozen=True)
class ExternalParams:
    """Somebody else's odometry or position fixes: how they are compared with ours, and when they are believed."""

    mode: str = parameter(
        "compare", "compare with them, or let them aid the foot's filter too", choices=("compare", "aid")
    )
    message: str = parameter(
        "odometry",
        "what comes: nav_msgs/Odometry, geometry_msgs/PoseWithCovarianceStamped, "
        "or known points, geometry_msgs/PointStamped: the person says where on the map she is",
        choices=("odometry", "pose", "point"),
    )
    body_window_s: float = parameter(
        1.1,
        "they follow the body: our foot's track is averaged over so long, about a stride; 0: they follow our sensor",
        unit="s",
        bounds=(0.0, 5.0),
    )
    sd_m: float = parameter(
        0.3, "noise of a fix whose covariance is not given", unit="m", bounds=(0.001, 100.0), source="UWB"
    )
    point_sd_m: float = parameter(
        0.1,
        "how well it is known where their point is seen from ours, beside the noise of a fix",
        unit="m",
        bounds=(0.001, 100.0),
        source="half a stance width",
    )
    offset_from: str = parameter(
        "person",
        "where the offset is seen from: their point from the person as she walks, or the person from their pose",
        choices=("person", "theirs"),
    )
    offset_x_m: float = parameter(0.0, "the offset ahead", unit="m", bounds=(-100.0, 100.0))
    offset_y_m: float = parameter(
        0.0,
        "the offset to the left; one that is not known is part of point_sd_m",
        unit="m",
        bounds=(-100.0, 100.0),
    )
    apart_s: float = parameter(
        0.9,
        "a fix so soon after another tells nothing new: its error is the same; known points all count",
        unit="s",
        bounds=(0.0, 60.0),
        source="the errors of a position source last",
    )
    height: bool = parameter(False, "their heights count too: off for robots that know only the plane")
    latency_s: float = parameter(
        0.2, "a fix that comes later than this may count one step later", unit="s", bounds=(0.0, 10.0)
    )
    clock_same_s: float = parameter(
        2.0, "a clock that differs by more counts from another moment", unit="s", bounds=(0.1, 1e6)
    )
    clock_sd_s: float = parameter(
        0.5, "by how much clocks differ that count from one moment", unit="s", bounds=(1e-4, 10.0)
    )
    drift_sd_radps: float = parameter(
        0.001,
        "how fast our track may turn while the frames are aligned",
        unit="rad/s",
        bounds=(0.0, 1.0),
        source="as fusion.drift_sd_radps",
    )
    aligned_sd_m: float = parameter(
        0.3,
        "the frames are aligned when the person's place is known so well, or as well as their point",
        unit="m",
        bounds=(0.001, 100.0),
    )
    aligned_sd_rad: float = parameter(0.02, "and the yaw between the frames", unit="rad", bounds=(1e-4, 1.0))
    aligned_sd_s: float = parameter(0.1, "and the clocks", unit="s", bounds=(1e-4, 10.0))
    gate: float = parameter(
        13.8,
        "normalised innovation squared beyond which a fix is not believed",
        bounds=(1.0, 1e9),
        source="chi-square, 2 degrees of freedom, 99.9 %",
    )
    drift_share: float = parameter(
        0.01,
        "our track may be off by this share of the way since the last fix that was believed, beyond what it says",
        bounds=(0.0, 1.0),
        source="measured on real walks",
    )
    window_s: float = parameter(15.0, "over so long the source and our track must agree", unit="s", bounds=(3.0, 600.0))
    window_gate: float = parameter(
        13.8,
        "normalised square of the speed at which they part beyond which the source is let go",
        bounds=(1.0, 1e9),
        source="chi-square, 2 degrees of freedom, 99.9 %",
    )
    silent_s: float = parameter(5.0, "a source is missed after so long, by stamps", unit="s", bounds=(0.1, 3600.0))
    map_frame: str = parameter("", "name of their frame; empty: as their messages say")
    publish_tf: bool = parameter(False, "broadcast their frame -> node.world_frame; one node at a time may")

    @property
    def known_points(self) -> bool:
        """Tell whether the person herself says where she is."""
        return self.message == "point"
