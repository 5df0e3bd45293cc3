"""The figures of `pdr bench --zhou`, of its first seed."""

from collections.abc import Iterator

import numpy as np

from pdr_core.bench.zhou_lengths import Lengths
from pdr_core.bench.zhou_modes import Change, Timeline
from pdr_core.bench.zhou_schemes import SCHEMES
from pdr_core.bench.zhou_tables import Drawn
from pdr_core.bench.zhou_testers import Observed
from pdr_core.evaluation.zhou_page import TRUTH, Chapter, Drawing, Series
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import ModeCommand

DRAWN_HZ = (200, 20)
FIGURES = {"walking": "figures 10 and 11", "running": "figures 13 and 14"}
METRES = ("x [m]", "y [m]")


def chapters(drawn: Drawn) -> list[Chapter]:
    """Return all figures."""
    found = [Chapter(f"Octagon, {gait}", list(octagon(drawn, gait))) for gait in drawn.octagons]
    found.append(Chapter("Step features", [features(drawn)]))
    if drawn.timeline:
        found.append(Chapter("Behaviours, modes and gyro", [behaviours(drawn.timeline), modes(drawn.timeline)]))
    if drawn.lengths:
        found.append(Chapter("Step lengths", [lengths(drawn.lengths)]))
    return found


def octagon(drawn: Drawn, gait: str) -> Iterator[Drawing]:
    """Yield the second lap at two rates, and what the first has shown of the deviation."""
    truth = drawn.octagons[gait]
    true_m = truth.stand_m[truth.half :] - truth.stand_m[truth.half]
    for rate_hz in DRAWN_HZ:
        series = [Series(TRUTH, *true_m.T)]
        for scheme in SCHEMES:
            track_m = drawn.tracks[gait, scheme, rate_hz].position_m
            series.append(Series(scheme, *(track_m - track_m[0]).T))
        caption = f"The strides of the second lap from above, as {FIGURES[gait]} of the paper."
        yield Drawing(f"Second lap at {rate_hz} Hz", caption, series, *METRES, to_scale=True)
    yield directions(drawn.observed[gait])
    yield deviation(drawn.observed[gait])


def directions(seen: Observed) -> Drawing:
    """Return where the foot points and where it goes, stride by stride."""
    series = [
        Series("heading of the foot", seen.stride, seen.heading_deg),
        Series("direction by place, eq. 20", seen.stride, seen.by_place_deg),
        Series("direction by velocity, eq. 21", seen.stride, seen.by_velocity_deg),
    ]
    caption = "On the first lap, as figure 7 of the paper. Degrees counter-clockwise from east."
    return Drawing("Heading and walking direction", caption, series, "Stride", "Direction [°]")


def deviation(seen: Observed) -> Drawing:
    """Return the deviation of each stride and the filter's."""
    apart = seen.by_place_deg - seen.heading_deg
    series = [
        Series(TRUTH, seen.stride, np.full(len(seen.stride), seen.true_deg)),
        Series("of each stride, eq. 20", seen.stride, (apart + 180.0) % 360.0 - 180.0, points=True),
        Series("filter, eq. 16-19", seen.stride, seen.deviation_deg),
    ]
    caption = "On the first lap, as figures 8 and 12 of the paper."
    return Drawing("Heading deviation", caption, series, "Stride", "Deviation [°]")


def features(drawn: Drawn) -> Drawing:
    """Return the features of usual and fast strides."""
    series = [Series(f.name, f.frequency_hz, f.mean_mps2, points=True) for f in drawn.features]
    caption = "Of each stride, as figure 9 of the paper: groups of strides lie apart by their frequency."
    return Drawing("Step features", caption, series, "Stride frequency [Hz]", "Mean |a| beside gravity [m/s²]")


def behaviours(timeline: Timeline) -> Drawing:
    """Return what the foot does, and what is known of it."""
    series = [held(TRUTH, timeline.true, 0.0), held("known", timeline.seen, 0.0)]
    caption = "Upper part of figure 15 of the paper: what the accelerometer tells, at the times at which it is known."
    return Drawing("Behaviours", caption, series, "Time [s]", "", levels=[b.name.lower() for b in Behaviour])


def held(name: str, row: list[Change], above: float) -> Series:
    """Return changes as a line of levels."""
    return Series(
        name, np.array([c.time_s for c in row]), np.array([c.behaviour.value + above for c in row]), steps=True
    )


def modes(timeline: Timeline) -> Drawing:
    """Return what navigates, and whether the gyro is on."""
    names = list(dict.fromkeys(c.mode for c in timeline.modes))
    levels = ["gyro off", "gyro on", *(mode.name.lower().replace("_", " ") for mode in names)]
    time_s = seconds(timeline.modes)
    mode = np.array([2.0 + names.index(c.mode) for c in timeline.modes])
    gyro = np.array([float(c.gyro) for c in timeline.modes])
    series = [Series("mode", time_s, mode, steps=True), Series("gyro", time_s, gyro, steps=True)]
    caption = "Lower part of figure 15 of the paper: what the manager commands."
    return Drawing("Modes and gyro", caption, series, "Time [s]", "", levels=levels)


def seconds(commands: list[ModeCommand]) -> np.ndarray:
    """Return when commands were given, since the first one, [s]."""
    return np.array([(c.stamp_ns - commands[0].stamp_ns) * 1e-9 for c in commands])


def lengths(found: Lengths) -> Drawing:
    """Return the length of every stride by all models."""
    series = [Series(TRUTH, found.stride, found.true_m)]
    series += [Series(name, found.stride, length_m) for name, length_m in found.by_model.items()]
    caption = "As figure 16 of the paper: the classical models were calibrated offline, ours on the way."
    return Drawing("Step lengths", caption, series, "Stride", "Length [m]")
