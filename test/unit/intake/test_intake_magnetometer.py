from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from intake_cases import only, taken
from scipy.spatial.transform import Rotation

from pdr_core.intake import Ingestion
from pdr_core.params import IntakeParams
from pdr_core.records import ImuBlock, Level, joined, length, part

MS, BEGIN_NS = 1_000_000, 10**18
INERTIAL = ("stamp_ns", "gyro_radps", "accel_mps2", "gyro_sd_radps", "accel_sd_mps2")
RATE_RADPS = np.array([0.3, -0.2, 1.0])


def turning(n=400, period_ms=10, rate_radps=RATE_RADPS, scale=1.0, noise=1e-7, seed=0):
    """A sensor that turns steadily in a field of 50 uT, which it shows with every sample."""
    stamps = BEGIN_NS + np.arange(n, dtype=np.int64) * period_ms * MS
    attitude = Rotation.from_rotvec(np.outer((stamps - BEGIN_NS) * 1e-9, rate_radps))
    field = attitude.inv().apply([0.0, 25e-6, -43.3e-6])
    field += noise * np.random.default_rng(seed).standard_normal((n, 3))
    rate, force = np.tile(np.asarray(rate_radps, float), (n, 1)), attitude.inv().apply([0.0, 0.0, 9.81])
    return ImuBlock(stamps, rate, force, np.zeros(n), np.zeros(n), field * scale, np.zeros(n))


def without_field(imu):
    return imu._replace(field_tesla=np.zeros((length(imu), 3)), field_sd_tesla=np.full(length(imu), -1.0))


def test_good_fields_pass_with_the_noise_of_the_sensor():
    imu = turning()
    out, notices = taken(imu)
    assert not notices
    np.testing.assert_array_equal(out.field_tesla, imu.field_tesla)
    np.testing.assert_array_equal(out.field_sd_tesla, np.full(400, 5e-7))


def test_the_noise_that_a_message_tells_comes_on_top():
    imu = turning()
    imu.field_sd_tesla[7] = 1.2
    out, _ = taken(imu._replace(field_tesla=imu.field_tesla * 1e6), mag_unit="uT")
    assert out.field_sd_tesla[7] == pytest.approx(1.3e-6)
    assert out.field_sd_tesla[8] == pytest.approx(5e-7)


@pytest.mark.parametrize(("unit", "tesla"), [("T", 1.0), ("uT", 1e-6), ("nT", 1e-9), ("G", 1e-4), ("mG", 1e-7)])
def test_units_are_converted(unit, tesla):
    out, notices = taken(turning(scale=1.0 / tesla), mag_unit=unit)
    assert not notices
    np.testing.assert_allclose(out.field_tesla, turning().field_tesla, rtol=1e-12)


MATRIX = np.array([[1.1, 0.02, -0.03], [0.04, 0.9, 0.05], [-0.06, 0.07, 1.2]])
OFFSET_TESLA = np.array([1e-5, -2e-5, 3e-6])
NAMES = [f"mag_matrix_{row}{column}" for row in "xyz" for column in "xyz"]


def test_the_calibration_comes_before_the_mounting():
    imu, angles = turning(), (0.3, -1.2, 2.5)
    params = dict(zip(NAMES, MATRIX.ravel().tolist(), strict=True))
    params |= {f"mag_offset_{axis}_tesla": float(v) for axis, v in zip("xyz", OFFSET_TESLA, strict=True)}
    params |= {f"mounting_{name}_rad": v for name, v in zip(("roll", "pitch", "yaw"), angles, strict=True)}
    out, _ = taken(imu, **params)
    sensor = (imu.field_tesla - OFFSET_TESLA) @ MATRIX.T
    np.testing.assert_allclose(out.field_tesla, Rotation.from_euler("xyz", angles).apply(sensor), atol=1e-18)


@pytest.mark.parametrize(
    ("value", "sd", "kind"),
    [
        (np.nan, 0.0, "mag_absurd"),
        (-np.inf, 0.0, "mag_absurd"),
        (1e300, 0.0, "mag_absurd"),
        (1e-2, 0.0, "mag_absurd"),
        (-4.9e-3, 0.0, "mag_saturated"),
        (5e-3, 0.0, "mag_saturated"),
        (4e-5, np.nan, "mag_absurd"),
        (4e-5, np.inf, "mag_absurd"),
        (4e-5, 1.0, "mag_absurd"),
    ],
)
def test_a_bad_field_costs_only_itself_and_is_named(value, sd, kind):
    imu = turning()
    imu.field_tesla[5, 1], imu.field_sd_tesla[5] = value, sd
    out, notices = taken(imu)
    notice = only(notices, kind)
    assert (notice.level, notice.count, notice.first_stamp_ns) == (Level.WARN, 1, imu.stamp_ns[5])
    np.testing.assert_array_equal(np.flatnonzero(out.field_sd_tesla < 0.0), [5])
    np.testing.assert_array_equal(out.field_tesla[5], np.zeros(3))


def test_texts_say_what_to_do():
    imu = turning()
    imu.field_tesla[5:7], imu.field_tesla[7:9] = 4.9e-3, np.nan
    notices = taken(imu)[1]
    assert notices["mag_saturated"].text.endswith("saturates: choose a larger range, or keep it away from iron")
    assert notices["mag_absurd"].text.endswith("beyond any range: left out; check intake.mag_unit")


FIELD_NUMBERS = st.sampled_from([0.0, 1e-5, 4e-5, -3e-5, 4.9e-3, 1.0, np.nan, np.inf, -1e300, 5e-324])
FIELD_ROWS = st.lists(
    st.tuples(*[FIELD_NUMBERS] * 3, st.sampled_from([0.0, 0.0, -1.0, 1e-6, np.nan, np.inf])), min_size=1, max_size=40
)


@given(FIELD_ROWS)
def test_whatever_the_field_the_inertial_part_keeps_its_bits(rows):
    imu = turning(n=40)
    imu.gyro_radps[10:14] = [[0.0, 5.0, 0.0], [0.0, 9.0, 0.0], [0.0, 9.0, 0.0], [0.0, 9.0, 0.0]]
    imu.stamp_ns[20:22] = imu.stamp_ns[[21, 20]]
    table = np.array(rows)
    imu.field_tesla[: len(rows)], imu.field_sd_tesla[: len(rows)] = table[:, :3], table[:, 3]
    out, bare = taken(imu)[0], taken(without_field(imu))[0]
    for name in INERTIAL:
        np.testing.assert_array_equal(getattr(out, name), getattr(bare, name))
    assert np.isfinite(out.field_tesla).all()
    assert np.isfinite(out.field_sd_tesla).all()


def test_a_field_that_is_said_to_be_missing_leaves_no_nan():
    imu = without_field(turning())
    imu.field_tesla[:] = np.nan
    out, notices = taken(imu)
    assert not notices
    np.testing.assert_array_equal(out.field_tesla, np.zeros((400, 3)))


def test_a_slow_magnetometer_counts_once_per_value():
    imu = turning(n=400)
    imu.field_tesla[:] = imu.field_tesla[np.arange(400) // 5 * 5]
    imu.field_sd_tesla[100:103] = -1.0  # the first of its kind is missing: the next one is new
    out, notices = taken(imu)
    assert not notices
    expected = np.arange(0, 400, 5)
    expected[20] = 103
    np.testing.assert_array_equal(np.flatnonzero(out.field_sd_tesla >= 0.0), expected)


def stuck(begin, end, n=400, **motion):
    imu = turning(n, **motion)
    imu.field_tesla[begin:end] = imu.field_tesla[begin]
    return imu


def test_a_stuck_magnetometer_is_named_until_it_moves():
    imu = stuck(100, 300)
    imu.field_tesla[311] = imu.field_tesla[310]
    out, notices = taken(imu)
    notice = only(notices, "mag_stuck")
    assert (notice.level, notice.count) == (Level.WARN, 99)  # after a second: from sample 201 on
    assert notice.text == "the magnetometer shows one value while it turns: left out; restart it, check its wiring"
    np.testing.assert_array_equal(np.flatnonzero(out.field_sd_tesla < 0.0), [*range(101, 300), 311])


@pytest.mark.parametrize(
    ("imu", "why"),
    [
        (stuck(100, 195), "less than a second"),
        (stuck(100, 220, rate_radps=(0.35, 0.0, 0.0)), "hardly a turn"),
        (stuck(100, 390, rate_radps=(0.2, 0.0, 0.2)), "at rest, with a bias"),
    ],
)
def test_a_repeated_value_need_not_be_stuck(imu, why):
    assert not taken(imu)[1], why


def test_zeros_are_no_field_and_a_magnetometer_that_dies_with_them_is_stuck():
    imu = turning()
    imu.field_tesla[100:] = 0.0
    out, notices = taken(imu)
    assert only(notices, "mag_stuck").count == 200
    np.testing.assert_array_equal(np.flatnonzero(out.field_sd_tesla >= 0.0), np.arange(100))
    assert not taken(turning(scale=0.0, noise=0.0))[1]


@pytest.mark.parametrize(
    ("unit", "scale", "probably"),
    [("T", 1e4, "G"), ("T", 1e6, "uT"), ("T", 1e9, "nT"), ("T", 1e7, "mG"), ("uT", 1e7, "mG"), ("mG", 1e6, "uT")],
)
def test_a_wrong_unit_is_told_once(unit, scale, probably):
    notice = taken(turning(scale=scale), mag_unit=unit)[1]["mag_unit"]
    assert (notice.level, notice.count, notice.first_stamp_ns) == (Level.ERROR, 1, BEGIN_NS)
    ending = f"probably in {probably}; set intake.mag_unit, or the unit in the column map, to {probably}"
    assert notice.text.endswith(ending)


@pytest.mark.parametrize("scale", [0.17, 18.0])
def test_a_field_near_iron_is_told(scale):
    notice = only(taken(turning(scale=scale))[1], "mag_uncalibrated")
    assert (notice.level, notice.count) == (Level.WARN, 1)
    assert notice.text.endswith("the Earth's is 22 to 67: not calibrated, or iron is near; run `pdr calibrate mag`")


def test_the_calibration_counts_before_the_field_is_judged():
    assert not taken(turning(scale=20.0), mag_matrix_xx=0.05, mag_matrix_yy=0.05, mag_matrix_zz=0.05)[1]


@given(st.lists(st.integers(0, 400), max_size=12))
@example(list(range(400)))
def test_a_stream_gives_the_bits_of_the_whole(cuts):
    imu = stuck(150, 320)
    imu.field_tesla[:150] = imu.field_tesla[np.arange(150) // 4 * 4] * 1e4
    imu.field_sd_tesla[:20] = -1.0
    imu.field_sd_tesla[200:270] = -1.0
    imu.field_tesla[:20] = imu.field_tesla[200:270] = 0.0
    imu.field_tesla[40, 0], imu.field_tesla[330, 0] = np.nan, 4.9e-3
    intake, edges = Ingestion(IntakeParams()), [0, *sorted(cuts), 400]
    pieces = [intake.run(part(imu, a, b)) for a, b in pairwise(edges)]
    found, (whole, notices) = joined([*pieces, intake.finish()]), taken(imu)
    assert len(notices) == 4
    assert {n.kind: n for n in intake.notices} == notices
    for a, b in zip(found, whole, strict=True):
        np.testing.assert_array_equal(a, b)
