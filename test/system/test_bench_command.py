import json

from support.processes import check_refused, pdr


def test_the_bench_prints_tables():
    run = pdr("bench", "--seeds", 2, "--length", 4.8)
    assert run.returncode == 0, run.stderr
    for text in ("Mechanisation alone", "Gui Table 1", "Consistency, true verdicts: 2 walks of 4.8 m", "too careful"):
        assert text in run.stdout
    assert "\x1b" not in run.stdout
    assert max(map(len, run.stdout.splitlines())) <= 120


def test_the_bench_prints_json():
    found = json.loads(pdr("bench", "--seeds", 2, "--length", 4.8, "--json").stdout)
    assert {row["rate_hz"] for row in found["mechanisation"]} >= {50.0, 1000.0}
    assert {row["sensor_model"] for row in found["table_1"]} >= {"gui_table_1", "gui_table_1_deg"}
    found = json.loads(pdr("bench", "--stress", "--seeds", 2, "--json").stdout)
    assert found["summary"][0]["walks"] == len(found["walks"]) == 2


def test_the_length_of_a_stress_walk_cannot_be_chosen():
    check_refused(pdr("bench", "--stress", "--length", 5), "--stress", "leave out --length")
