"""Samples that are written and read again, for the tests of the export."""

from pathlib import Path

import numpy as np
import pytest
from small_bags import START_NS, STEP_NS

from pdr_core.recording import Sensor, Session, open_recording
from pdr_core.recording.export import write_recording
from pdr_core.records import inertial_block, joined

COUNT = 60
OUTPUTS = pytest.mark.parametrize("name", ["out", "out.mcap", "out.csv"])


def block(session, name=None):
    sensor = session.sensors[name] if name else next(iter(session.sensors.values()))
    return joined(list(sensor.pieces(17)))


def check_same(one, other):
    for a, b in zip(one, other, strict=True):
        np.testing.assert_array_equal(a, b)


def converted(source, output, **options):
    """Convert, open what came out, and check that every sample is what it was, to the last bit."""
    session = open_recording(source)
    write_recording(session, list(session.sensors.values()), output, **options)
    after = open_recording(output)
    assert len(after.sensors) == len(session.sensors)
    for name in session.sensors:
        check_same(block(after, name), block(session, name))
    return session, after


def in_memory(samples, truth=None, name="imu"):
    """A session of one sensor that never was a file."""
    return Session("made", Path("made"), "made", {name: Sensor(name, truth, lambda _: iter([samples]))})


def noise(count, seed=3):
    rng = np.random.default_rng(seed)
    stamps = START_NS + np.arange(count) * STEP_NS
    return inertial_block(
        stamps, rng.normal(size=(count, 3)), rng.normal(size=(count, 3)), np.zeros(count), np.zeros(count)
    )


def with_field(samples, there, sd=0.0):
    """Samples of which those that are flagged have a field."""
    field = np.where(there[:, None], np.random.default_rng(5).normal(0.0, 5e-5, (len(there), 3)), 0.0)
    return samples._replace(field_tesla=field, field_sd_tesla=np.where(there, sd, -1.0))
