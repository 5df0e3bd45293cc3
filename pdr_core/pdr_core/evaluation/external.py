"""What came of somebody else's odometry beside ours: for a result and for a person."""

from typing import Any, NamedTuple

import numpy as np

from pdr_core.evaluation.words import metres
from pdr_core.records_external import ExternalComparison


class External(NamedTuple):
    """Which topic it was, whether it aided, and how both compare."""

    topic: str  # "": points at which the person said to be
    aided: bool
    comparison: ExternalComparison

    def to_mapping(self) -> dict[str, Any]:
        """Return it for JSON; the deviations are those at the place that the frame is known best."""
        frame, content = self.comparison.frame, {"topic": self.topic, "aided": self.aided}
        content |= {"pairs": self.comparison.pairs, "ate_m": self.comparison.ate_m, "frame": None}
        if frame:
            content["frame"] = {
                "yaw_rad": frame.yaw_rad,
                "shift_m": frame.shift_m,
                "clock_s": frame.clock_ns * 1e-9,
                "about_m": frame.about_m,
                "covariance_x_y_yaw_clock": frame.covariance,
            }
        return content

    def in_words(self) -> str:
        """Return one sentence."""
        frame, seen = self.comparison.frame, self.comparison
        if not self.topic:
            return points_in_words(seen)
        if frame is None:
            takes = "its frame takes a walk of some 20 m, and fixes that agree"
            return f"{self.topic} could not be laid beside the track: {takes}."
        sd_deg, sd_s = np.degrees(np.sqrt(frame.covariance[2, 2])), np.sqrt(frame.covariance[3, 3])
        turn = f"its frame is turned by {np.degrees(frame.yaw_rad):.1f} ± {sd_deg:.1f} deg"
        clock = f"its clock is ahead by {frame.clock_ns * 1e-9:.2f} ± {sd_s:.2f} s"
        how = "aided the track, which" if self.aided else "was compared with the track, which"
        return f"{self.topic} {how} lies {metres(seen.ate_m)} from its fixes (RMS of {seen.pairs}); {turn}, {clock}."


def points_in_words(seen: ExternalComparison) -> str:
    """Return one sentence of known points."""
    if seen.frame is None:
        return (
            "The track is not on the map: that takes two known points, some way off, as far from each other as walked."
        )
    turn_deg, sd_deg = np.degrees([seen.frame.yaw_rad, np.sqrt(seen.frame.covariance[2, 2])])
    turned = f"the map is turned by {turn_deg:.1f} ± {sd_deg:.1f} deg"
    return f"{seen.pairs} known points lie {metres(seen.ate_m)} from the track (RMS); {turned}."
