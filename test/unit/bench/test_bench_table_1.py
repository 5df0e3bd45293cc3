import pytest

from pdr_core.bench.table_1 import MODELS, table_1_results, told_of
from pdr_core.params import Params

RESULTS = {(r.sensor_model, r.told): r for r in table_1_results()}


def test_every_sensor_walks_the_rectangle_as_delivered_and_told():
    assert list(RESULTS) == [(model, told) for model in MODELS for told in (False, True)]
    assert all(r.distance_m == pytest.approx(100.8) and r.true_strides == 88 for r in RESULTS.values())


def test_without_noise_it_closes_and_a_consumer_sensor_is_not_far_off():
    assert RESULTS["ideal", False].end_error_percent < 0.3  # measured: 0.13
    assert RESULTS["consumer", False].end_error_percent < 3.0  # measured: 1.5
    assert RESULTS["consumer", False].strides == 88


def test_ten_times_the_noise_of_the_data_sheet_is_survived_and_the_table_as_printed_is_not():
    deg, printed = (RESULTS[model, True] for model in ("gui_table_1_deg", "gui_table_1"))
    assert deg.end_error_percent < 20.0  # measured: 10.4
    assert deg.end_error_percent < 0.9 * RESULTS["gui_table_1_deg", False].end_error_percent  # measured: 14.7
    assert deg.strides == 88
    assert printed.end_error_percent > 1000.0
    assert printed.strides == 0
    assert "no_stance" in printed.notices


def test_a_suite_is_told_noise_and_biases_but_never_less_than_it_assumes():
    assert told_of("ideal") == Params()
    told = told_of("gui_table_1")
    assert (told.intake.gyro_noise_density, told.intake.accel_noise_density) == (0.1, 0.1)
    assert (told.filter.initial_gyro_bias_sd_radps, told.filter.initial_accel_bias_sd_mps2) == (0.03491, 0.2)
