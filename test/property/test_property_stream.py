"""A stream cut anywhere, copied anywhere and resumed gives the same bits as the whole; and nothing breaks the chain."""

import copy
import warnings
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pdr_core.eskf import ZuptFilter
from pdr_core.eskf.output import empty_nav
from pdr_core.intake import Ingestion
from pdr_core.intake.stamp_policy import StampPolicy
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial, SmoothedFoot
from pdr_core.records import ImuBlock, inertial_block, joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.stance import StanceDetection

PARAMS = Params()


def troubled_walk():
    """Return a walk with gap, restart, clock set, duplicate, swap, stray, burst, NaN, clipped rates, gyro pauses.

    Its magnetometer is slow, and absent, saturated, stuck and in gauss at times.
    """
    sim = simulated_walk(SimulationParams(walk="straight", walk_length_m=4.8, sample_rate_hz=100.0), start_ns=10**18)
    imu = ImuBlock(*(column.copy() for column in sim.imu))
    imu.stamp_ns[450:] += 700_000_000
    imu.stamp_ns[601] = imu.stamp_ns[600]
    imu.gyro_radps[601], imu.accel_mps2[601] = imu.gyro_radps[600], imu.accel_mps2[600]
    imu.stamp_ns[610] = imu.stamp_ns[609]
    imu.stamp_ns[620:622] = imu.stamp_ns[[621, 620]]
    imu.stamp_ns[630] += 3_600_000_000_000
    imu.stamp_ns[640:645] = imu.stamp_ns[644] + np.arange(5) * 100_000
    imu.stamp_ns[650] -= 60_000_000
    imu.stamp_ns[950:] += 7_200_000_000_000
    imu.stamp_ns[800:] -= 30_000_000_000
    imu.accel_mps2[333, 1] = np.nan
    imu.gyro_radps[700:704] = 34.9
    imu.gyro_radps[500:507] = np.outer([2.0, 5.0, 6.0, 6.02, 6.0, 4.5, 2.0], [0.3, 1.0, -0.9])
    imu.gyro_radps[550:570, 2] = -7.0  # a plateau that lasts too long
    imu.gyro_sd_radps[900:930] = -1.0
    imu.field_tesla[:] = 4e-5 * np.sin(np.arange(length(imu)) // 4)[:, None]
    imu.field_tesla[:300] *= 1e4
    imu.field_tesla[320], imu.field_tesla[340, 1], imu.field_tesla[350:600] = 4.9e-3, np.nan, 2e-5
    imu.field_sd_tesla[50:] = 0.0
    imu.field_sd_tesla[700:800] = -1.0
    return imu


RAW = troubled_walk()


def whole(stage, block):
    return joined([stage.run(block), stage.finish()])


TRUSTED = whole(Ingestion(PARAMS.intake), RAW)
JUDGED = whole(StanceDetection(PARAMS.stance, PARAMS.place), TRUSTED)


class Intake:
    def __init__(self):
        self.stage = Ingestion(PARAMS.intake)

    def run(self, block):
        return self.stage.run(block), []

    def finish(self):
        return self.stage.finish(), self.stage.notices


class Stamps(Intake):
    def __init__(self):
        self.stage = StampPolicy(PARAMS.intake)


class EvenStamps(Intake):
    def __init__(self):
        self.stage = StampPolicy(changed(PARAMS, "intake", constant_rate_hz=101.0).intake)


class Stance:
    def __init__(self):
        self.stage = StanceDetection(PARAMS.stance, PARAMS.place)

    def run(self, block):
        return self.stage.run(block), []

    def finish(self):
        return self.stage.finish(), []


class Filter:
    def __init__(self):
        self.stage = ZuptFilter(PARAMS.filter, PARAMS.place)

    def run(self, block):
        return self.stage.run(block)

    def finish(self):
        return self.stage.run(part(JUDGED, 0, 0))[0], [*self.stage.finish(), *self.stage.notices, self.stage.health]


class Chain:
    def __init__(self):
        self.stage = FootInertial(PARAMS)

    def run(self, block):
        out = self.stage.run(block)
        return out.nav, out.steps

    def finish(self):
        out = self.stage.finish()
        return out.nav, [*out.steps, *self.stage.notices]


class Smoothed:
    def __init__(self):
        self.stage = SmoothedFoot(PARAMS)

    def run(self, block):
        self.stage.run(block)
        return empty_nav(0), []

    def finish(self):
        outputs = list(self.stage.finish())
        steps = [step for out in outputs for step in out.steps]
        return joined([empty_nav(0), *(out.nav for out in outputs)]), [*steps, *self.stage.notices]


STAGES = {
    "stamps": (Stamps, RAW),
    "even_stamps": (EvenStamps, RAW),
    "intake": (Intake, RAW),
    "stance": (Stance, TRUSTED),
    "filter": (Filter, JUDGED),
    "chain": (Chain, RAW),
    "smoothed": (Smoothed, RAW),
}


def columns(block):
    return [column for c in block for column in (columns(c) if isinstance(c, tuple) else [c])]


def run_in_pieces(stage, block, cuts):
    edges = [0, *sorted(cuts), length(block)]
    outs = [stage.run(part(block, a, b)) for a, b in pairwise(edges)] + [stage.finish()]
    return joined([block for block, _ in outs]), [repr(event) for _, events in outs for event in events]


def assert_same(found, expected):
    for a, b in zip(columns(found[0]), columns(expected[0]), strict=True):
        np.testing.assert_array_equal(a, b)
    assert sorted(found[1]) == sorted(expected[1])  # kinds of notices that first appear in one block have no order


WHOLE = {name: run_in_pieces(stage(), block, []) for name, (stage, block) in STAGES.items()}
CUTS = st.lists(st.integers(0, length(RAW)), max_size=12)


@pytest.mark.parametrize("name", STAGES)
@given(cuts=CUTS)
@settings(max_examples=30)
def test_a_stream_gives_the_bits_of_the_whole(name, cuts):
    stage, block = STAGES[name]
    assert_same(run_in_pieces(stage(), block, [min(c, length(block)) for c in cuts]), WHOLE[name])


@pytest.mark.parametrize("name", STAGES)
def test_sample_by_sample_gives_the_bits_of_the_whole(name):
    stage, block = STAGES[name]
    assert_same(run_in_pieces(stage(), block, range(1, length(block))), WHOLE[name])


@pytest.mark.parametrize("name", STAGES)
@given(at=st.integers(0, length(RAW)))
@settings(max_examples=30)
def test_a_copy_resumes_anywhere(name, at):
    make, block = STAGES[name]
    stage = make()
    first = stage.run(part(block, 0, at))
    resumed = copy.deepcopy(stage)
    stage.run(part(block, at))  # what the original does must not reach the copy
    rest, end = resumed.run(part(block, at)), resumed.finish()
    events = [repr(event) for _, found in (first, rest, end) for event in found]
    assert_same((joined([first[0], rest[0], end[0]]), events), WHOLE[name])


NUMBERS = st.one_of(
    st.floats(-50, 50),
    st.sampled_from([np.nan, np.inf, -np.inf, 0.0, 9.81, 1e5, -999999.0, 1e6, 1e12, 1e300, -1e308, 5e-324]),
)
JUMPS = st.one_of(
    st.integers(0, 20_000_000),
    st.sampled_from([5_000_000] * 4 + [-1, -3_000_000, 10**8, 10**9, -(10**10), 10**13, 10**18, -(10**18), 2**62]),
)
SAMPLES = st.lists(
    st.tuples(JUMPS, *[NUMBERS] * 6, st.sampled_from([0.0, 0.0, 0.0, -1.0, 0.01])), min_size=1, max_size=60
)


def mad_block(samples, start_ns):
    stamps, stamp = [], start_ns
    for jump, *_ in samples:
        stamp = (stamp + jump + 2**63) % 2**64 - 2**63
        stamps.append(stamp)
    table = np.array([s[1:] for s in samples], float)
    sd = table[:, 6].copy()
    return inertial_block(np.array(stamps, np.int64), table[:, :3].copy(), table[:, 3:6].copy(), sd, np.zeros(len(sd)))


def assert_sound(nav, steps):
    for column in nav:
        assert np.all(np.isfinite(column))
    np.testing.assert_allclose(np.linalg.norm(nav.quat_xyzw, axis=1), 1.0, atol=1e-9)
    assert all(np.all(np.diagonal(c, axis1=1, axis2=2) >= 0) for c in (nav.pose_covariance, nav.twist_covariance))
    assert all(np.isfinite([s.length_m, s.heading_sd_rad, s.yaw_rad, s.yaw_sd_rad]).all() for s in steps)


LEFT_OUT = ("duplicate_stamp", "equal_stamps", "no_stamp", "late_stamp", "stray_stamp")


@pytest.mark.parametrize("rate_hz", [0.0, 20.0, 100.0, 4000.0])
@given(SAMPLES, st.integers(-(2**63), 2**63 - 1))
@settings(max_examples=100)
def test_stamps_increase_and_what_is_left_out_is_named(rate_hz, samples, start_ns):
    policy = StampPolicy(changed(PARAMS, "intake", constant_rate_hz=rate_hz).intake)
    raw = mad_block(samples, start_ns)
    out = whole(policy, raw)
    told = {n.kind: n.count for n in policy.notices}
    named = sum(told.get(kind, 0) for kind in LEFT_OUT)
    assert np.count_nonzero(np.diff(out.stamp_ns) <= 0) <= told.get("clock_jumped_back", 0)
    assert named <= length(raw) - length(out) <= named + told.get("constant_rate", 0)


def interrupted(at, samples, start_ns, at_its_time):
    """A recording with mad samples in between, stamped as they should be there or from `start_ns` on."""
    begin = int(RAW.stamp_ns[min(at, length(RAW) - 1)]) if at_its_time else start_ns
    return part(RAW, 0, at), mad_block(samples, begin), part(RAW, at)


@given(st.integers(0, length(RAW)), SAMPLES, st.integers(-(2**63), 2**63 - 1), st.booleans())
@settings(max_examples=100)
def test_nothing_that_comes_in_brings_the_smoother_down(at, samples, start_ns, at_its_time):
    chain = SmoothedFoot(PARAMS)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        for block in interrupted(at, samples, start_ns, at_its_time):
            chain.run(block)
        for out in chain.finish():
            assert_sound(out.nav, out.steps)


@given(st.integers(0, length(RAW)), SAMPLES, st.integers(-(2**63), 2**63 - 1), st.booleans())
@settings(max_examples=300)
def test_nothing_that_comes_in_brings_the_chain_down(at, samples, start_ns, at_its_time):
    chain = FootInertial(PARAMS)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # a step across 30 years has no covariance of its own
        for block in interrupted(at, samples, start_ns, at_its_time):
            out = chain.run(block)
            assert_sound(out.nav, out.steps)
        end = chain.finish()
        assert_sound(end.nav, end.steps)
    health = chain._filter.health
    assert 0.0 <= health.quality <= 1.0
    assert np.isfinite([health.position_sd_m, health.tilt_sd_rad, health.yaw_sd_rad, health.velocity_sd_mps]).all()
