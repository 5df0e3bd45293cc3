"""The heading constraint of one foot: a step in, its heading observation out."""

from collections.abc import Callable
from math import isfinite

from pdr_core.heading.building import BuildingDirections
from pdr_core.heading.directions import Directions
from pdr_core.heading.dominant import DominantDirection
from pdr_core.heading.ihde import WeightedBuildingDirections
from pdr_core.heading.learned import LearnedDirections
from pdr_core.heading.line import Heading, Line, YawMeasurement
from pdr_core.heading.spread import Spread
from pdr_core.heading.straight import LastStrides
from pdr_core.notices import Tally
from pdr_core.params import HeadingParams
from pdr_core.records import HeadingObservation, Level, Notice, StepEvent, empty_answer

ON = "the heading constraint is on ({}): where straight lines do not have the directions it takes, it turns the track"
UNKNOWN_YAW_SD_RAD = 1.0  # with a yaw known no better, no direction can be told from another
HELD = "strides by which the heading constraint has told the filter its yaw"
FIXED = "the heading constraint can tell nothing to a filter that does not estimate its yaw: set filter.heading_states"


class HeadingConstraint:
    """Holds the heading of one foot on straight lines; in curves it says nothing, and after them it begins anew."""

    def __init__(self, params: HeadingParams, tally: Tally | None = None) -> None:
        """Feet of one person share a `tally`."""
        self._params = params
        self._last: StepEvent | None = None
        self._tally = tally or Tally()
        self._begin()

    def _begin(self) -> None:
        p = self._params
        self._strides = LastStrides(p.straight_strides, p.straight_max_rad)
        self._spread = Spread(p.stride_sd_rad)
        self._directions = directions(p)
        self._line: Line | None = None

    def answer(self, step: StepEvent) -> HeadingObservation:
        """Return by how much the track is turned too far, as far as this step tells; source NONE: it does not."""
        if self._directions is None:
            return empty_answer(step)
        self._follow(step)
        measured = self._measured(step, self._directions)
        if measured is None:
            return empty_answer(step)
        self._tally.add("heading_held", Level.OK, HELD, step.stamp_ns)
        return HeadingObservation(
            step.index, step.stamp_ns, step.answer_due_ns, self._directions.source, measured.error_rad, measured.sd_rad
        )

    def _follow(self, step: StepEvent) -> None:
        """Begin anew where the steps do; a clock that has jumped back, and a step that was lost, end the line alone."""
        last, self._last = self._last, step
        if last is None:
            self._tally.once("heading_on", Level.WARN, ON.format(self._params.constraint), step.stamp_ns)
        elif step.index <= last.index:
            self._begin()
        elif step.index != last.index + 1 or step.start_ns < last.stamp_ns:
            self._break_off()

    def _break_off(self) -> None:
        self._strides.clear()
        self._line = None

    def _measured(self, step: StepEvent, directions: Directions) -> YawMeasurement | None:
        """Return what the step tells of the yaw, if it is one of a straight line."""
        if step.yaw_sd_rad == 0.0:
            self._tally.once("heading_fixed", Level.WARN, FIXED, step.stamp_ns)
        heading_rad = step.yaw_rad if self._params.walking_direction == "foot" else step.heading_rad
        if not (isfinite(heading_rad) and isfinite(step.length_m) and 0.0 < step.yaw_sd_rad < UNKNOWN_YAW_SD_RAD):
            self._break_off()
            return None
        if step.length_m < self._params.stride_min_m:
            return None
        self._strides.add(heading_rad)
        if not self._strides.straight:
            self._line = None
            return None
        self._spread.add(self._strides.deviations_rad[-1], len(self._strides.headings_rad))
        return self._on_line(step.yaw_sd_rad**2, directions)

    def _on_line(self, yaw_variance_rad2: float, directions: Directions) -> YawMeasurement | None:
        """Return what the last of the strides tells: at the beginning of a line all of them, later the newest."""
        spread_rad2, strides = self._spread.variance_rad2, self._strides
        if self._line:
            self._line.wander(self._params.wander_spreads**2 * spread_rad2)
        line, seen = self._line, Heading(strides.headings_rad[-1], spread_rad2, yaw_variance_rad2)
        if line is None:
            seen = Heading(strides.mean_rad, spread_rad2 / len(strides.headings_rad), yaw_variance_rad2)
            line = directions.line(strides, seen, self._params.direction_spreads**2 * spread_rad2)
        if line is None or not line.fits(seen, self._params.gate):
            return None
        self._line, measured = line, line.told(seen)
        if measured:
            strides.turn(measured.turn_by_filter_rad(yaw_variance_rad2))
        return measured

    @property
    def notices(self) -> list[Notice]:
        """That it is on, and how many strides it has used."""
        return self._tally.notices


def directions(params: HeadingParams) -> Directions | None:
    """Return what knows the directions of lines; None: nothing does."""
    kinds: dict[str, Callable[[HeadingParams], Directions]] = {
        "dominant": lambda _: DominantDirection(),
        "hde": BuildingDirections,
        "ihde": WeightedBuildingDirections,
        "learned": LearnedDirections,
    }
    return kinds[params.constraint](params) if params.constraint in kinds else None
