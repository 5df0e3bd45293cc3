"""What a walk costs, and how far off it ends, by when the gyro is on: one half calibrates, the second is judged.

Each scheme is a set of parameters of `FootAdaptive`, with half of the walk as L0. Times and true places are those of
the steps that the filter finds with its gyro always on; the truth is laid on the track over the first half. So an end
error is what the second half has made, in % of the whole walk; a gyro is on while it is powered, settled or not.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from pdr_core.bench.gyro_off_walk import true_places_m
from pdr_core.bench.trial import Walk
from pdr_core.evaluation import alignment
from pdr_core.evaluation.metrics import closure_2d_m, path_length_m, percent
from pdr_core.params import Params, changed
from pdr_core.pipeline import FootAdaptive, FootInertial
from pdr_core.records import Floats, NavBlock, Stamps, StepEvent, joined, part
from pdr_core.records_power import PowerState
from pdr_core.simulation import simulated_walk

ALWAYS = "always on"
SWING = "swing"
LINES = "swing, learned lines"
FAST = "swing, ready in 2 ms"
Values = dict[str, dict[str, object]]  # of the groups of parameters
NEVER: dict[str, object] = {"suspicion_rad": 3.0}
NO_EXAMINATION: dict[str, object] = {"examine_every_s": 1e4}
SCHEMES: dict[str, Values] = {
    ALWAYS: {},
    SWING: {"power": {"duty": "swing"}},
    LINES: {"power": {"duty": "swing"}, "heading": {"constraint": "learned"}},
    "swing, 50 ms longer": {"power": {"duty": "swing", "strike_on_s": 0.08}},
    "swing, 30 ms shorter": {"power": {"duty": "swing", "strike_on_s": 0.0}},
    FAST: {"power": {"duty": "swing", "part": "bmi270"}},
    "swing, ready in 2 ms, 30 ms shorter": {"power": {"duty": "swing", "part": "bmi270", "strike_on_s": 0.0}},
    "turns, two calm strides": {},
    "turns, one calm stride": {"power": {"calm_strides": 1}},
    "sharp turns, one calm stride": {"power": {"calm_strides": 1}, "dead_reckoning": {"suspicion_rad": 0.4}},
    "one stride of two": {
        "power": {"duty": "strides", "duty_of_strides": 2, **NO_EXAMINATION},
        "dead_reckoning": NEVER,
    },
    "never on": {"power": NO_EXAMINATION, "dead_reckoning": NEVER},
}
SIMULATED: Values = {"outdoors": {}, "indoors": {"indoor_field": 0.25}}
SIMULATED_M = 240.0
NOT_COUNTED = "{}: the steps with the gyro always on are not those of the truth: {} of {}"


@dataclass(frozen=True)
class EnergyRun:
    """The second half of one walk by one scheme."""

    walk: str
    scheme: str
    gyro_share: float  # of the time of the second half
    end_error_percent: float  # of the whole distance
    distance_error_percent: float  # of the second half; too far is positive
    strides_missed: int  # of the second half; negative: too many
    switch_ons: int
    sensor_saved_share: float  # of the charge of the whole walk


class Unpaired(Exception):  # noqa: N818  (what a person meets)
    """Steps that are not those of the truth; the text says why."""


@dataclass(frozen=True)
class Known:
    """A walk with its true places at the ends of its strides."""

    walk: Walk
    stamp_ns: Stamps  # (strides + 1,)
    truth_m: Floats  # (strides + 1, 2)

    @property
    def distance_m(self) -> float:
        """The length of the walk."""
        return path_length_m(self.truth_m)


def known(walk: Walk) -> Known:
    """Return a walk with the steps that the gyro, always on, finds; Unpaired: they are not those of the truth."""
    nav, steps = told(FootInertial(Params()), walk)
    stamps = np.array([steps[0].start_ns, *(step.stamp_ns for step in steps)]) if steps else np.zeros(0, np.int64)
    truth_m = true_places_m(walk.truth, at(nav, stamps))
    if len(truth_m) != len(stamps) or len(stamps) < 4:
        raise Unpaired(NOT_COUNTED.format(walk.name, len(stamps) - 1, len(truth_m) - 1))
    return Known(walk, stamps, truth_m)


def energy_runs(found: Known, schemes: Sequence[str], seen: Callable[[str], object] = str) -> list[EnergyRun]:
    """Return the second half of a walk by each of the schemes; `seen` is told which."""
    runs = []
    for scheme in schemes:
        seen(f"{found.walk.name}, {scheme}")
        runs.append(energy_run(found, scheme))
    return runs


def energy_run(found: Known, scheme: str) -> EnergyRun:
    """Return the second half of a walk by one scheme of SCHEMES."""
    params = changed(Params(), "power", calibration_m=0.5 * found.distance_m)
    for group, values in SCHEMES[scheme].items():
        params = changed(params, group, **values)
    chain = FootAdaptive(params)
    nav, steps = told(chain if scheme != ALWAYS else FootInertial(params), found.walk)
    over_ns = next((c.stamp_ns for c in chain.commands if c.number > 1), int(found.stamp_ns[len(found.stamp_ns) // 2]))
    return judged(found, scheme, nav, steps, over_ns, chain)


def judged(
    found: Known, scheme: str, nav: NavBlock, steps: list[StepEvent], over_ns: int, chain: FootAdaptive
) -> EnergyRun:
    """Return how good the second half was, which begins at a stamp."""
    half = int(np.searchsorted(found.stamp_ns, over_ns, side="right")) - 1
    end_ns = int(found.stamp_ns[-1])
    places_m = at(nav, found.stamp_ns).position_m[:, :2]
    laid_m = alignment.over_whole(found.truth_m[: half + 1], places_m[: half + 1]).apply(found.truth_m)
    second = [step for step in steps if found.stamp_ns[half] < step.stamp_ns <= end_ns]
    true_m = path_length_m(found.truth_m[half:])
    return EnergyRun(
        found.walk.name,
        scheme,
        on_share(chain.powered, over_ns, end_ns) if scheme != ALWAYS else 1.0,
        percent(closure_2d_m(places_m[-1], laid_m[-1]), found.distance_m),
        percent(sum(step.length_m for step in second) - true_m, true_m),
        len(found.stamp_ns) - 1 - half - len(second),
        chain.energy.switch_ons,
        chain.energy.sensor_saved_share,
    )


def on_share(powered: Sequence[PowerState], first_ns: int, last_ns: int) -> float:
    """Return the share of a time in which the gyro is powered; before the first state it is on."""
    begins = [state for state in powered if state.stamp_ns <= first_ns][-1:]
    on, since_ns, total_ns = begins[0].gyro_on if begins else True, first_ns, 0
    for state in [s for s in powered if first_ns < s.stamp_ns < last_ns]:
        total_ns += on * (state.stamp_ns - since_ns)
        on, since_ns = state.gyro_on, state.stamp_ns
    return (total_ns + on * (last_ns - since_ns)) / (last_ns - first_ns)


def told(chain: FootInertial | FootAdaptive, walk: Walk) -> tuple[NavBlock, list[StepEvent]]:
    """Return the estimates and steps of a walk."""
    found = [*map(chain.run, walk.pieces), chain.finish()]
    return joined([output.nav for output in found]), [step for output in found for step in output.steps]


def at(nav: NavBlock, stamp_ns: Stamps) -> NavBlock:
    """Return the estimates that hold at stamps."""
    rows = np.maximum(np.searchsorted(nav.stamp_ns, stamp_ns, side="right") - 1, 0)
    return joined([part(nav, 0, 0), *(part(nav, row, row + 1) for row in rows.tolist())])


def simulated(where: str, seed: int) -> Walk:
    """Return a simulated walk of SIMULATED, with heels that strike and a magnetometer."""
    params = changed(
        Params(), "simulation", motion="smooth", walk="rectangle", walk_length_m=SIMULATED_M, shock_mps2=60.0,
        magnetometer=True, seed=seed, **SIMULATED[where],
    )  # fmt: skip
    walk = simulated_walk(params.simulation, params.place)
    return Walk(f"{where}, simulated", [walk.imu], walk.truth)


def means(runs: Sequence[EnergyRun]) -> list[EnergyRun]:
    """Return the mean over walks of each scheme."""
    return [mean([run for run in runs if run.scheme == scheme]) for scheme in dict.fromkeys(r.scheme for r in runs)]


def mean(runs: Sequence[EnergyRun]) -> EnergyRun:
    """Return the mean of runs by one scheme: of distance errors, that of their size; of counts, the sum."""
    return EnergyRun(
        "mean",
        runs[0].scheme,
        float(np.mean([run.gyro_share for run in runs])),
        float(np.mean([run.end_error_percent for run in runs])),
        float(np.mean([abs(run.distance_error_percent) for run in runs])),
        sum(run.strides_missed for run in runs),
        sum(run.switch_ons for run in runs),
        float(np.mean([run.sensor_saved_share for run in runs])),
    )
