"""The driver and its stand-in of offline runs obey alike."""

import numpy as np

from pdr_core.records import ImuBlock, joined
from pdr_nodes.devices.player import Player
from pdr_nodes.devices.source import Source
from support.switched import PLAN, RATE_HZ, RULE, SETTLE_S, command, driven, recording, strides


def test_it_obeys_as_the_live_driver_does():
    imu = recording()
    out, answers, _ = driven([imu])
    player = Player(Source("", iter([imu]), None), SETTLE_S)
    for answer, asked in zip(answers, PLAN.values(), strict=True):
        player.interval_s = 1.0 / RATE_HZ
        player.set_gyro_power(asked.gyro, answer.effective_ns)
        player.set_sample_rate(asked.rate_hz, answer.effective_ns)
    live = []
    while player.next is not None:
        live.append(player.take())
    for name, column in ImuBlock._asdict(joined(live)).items():
        assert np.array_equal(column, getattr(out, name)), name


def test_a_sensor_that_switches_by_itself_does_so_alike():
    imu = strides()
    plan = {0.5: command(1, True, on_motion=True), 3.2: command(2, True), 4.3: command(3, True, on_motion=True)}
    out, answers, _ = driven([imu], plan)
    player = Player(Source("", iter([imu]), None), SETTLE_S)
    for answer, asked in zip(answers, plan.values(), strict=True):
        if asked.on_motion:
            player.set_gyro_on_motion(RULE, answer.effective_ns)
        else:
            player.set_gyro_power(asked.gyro, answer.effective_ns)
    live = []
    while player.next is not None:
        live.append(player.take())
    measured = out.gyro_sd_radps >= 0.0
    assert 0.3 < measured.mean() < 0.9
    for name, column in ImuBlock._asdict(joined(live)).items():
        assert np.array_equal(column, getattr(out, name)), name
