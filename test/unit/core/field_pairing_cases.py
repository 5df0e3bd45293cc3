"""Samples and fields that are told apart, and who belongs to whom by brute force."""

from itertools import pairwise

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.records import inertial_block, joined

STEP_NS, WAIT_NS = 5_000_000, 50_000_000


def samples(stamp_ns):
    """Samples that are told apart by their rate."""
    n = len(stamp_ns)
    gyro = np.arange(3.0 * n).reshape(n, 3)
    return inertial_block(np.asarray(stamp_ns, np.int64), gyro, -gyro, np.zeros(n), np.zeros(n))


def put(pairing, stamp_ns, sd=0.0):
    """Measure fields whose x axis tells their stamp."""
    stamp_ns = np.asarray(stamp_ns, np.int64)
    field = np.column_stack([stamp_ns, np.ones((len(stamp_ns), 2))]).astype(np.float64)
    pairing.take_field(stamp_ns, field, np.full(len(stamp_ns), sd))


def taken(block):
    """The stamp of the field that each sample has, None where there is none."""
    there = zip(block.field_tesla[:, 0], block.field_sd_tesla, strict=True)
    return [int(x) if sd >= 0.0 else None for x, sd in there]


def expected(sample_ns, field_ns, reach_ns):
    """Every pair by brute force: the field's nearest sample, and of its fields the nearest."""
    found = {}
    for f in field_ns:
        s = min(sample_ns, key=lambda s: (abs(s - f), s))
        if abs(s - f) <= reach_ns(s):
            found[s] = min(found.get(s, f), f, key=lambda g: (abs(g - s), g))
    return [found.get(s) for s in sample_ns]


def arrive(pairing, arrivals):
    """Run ('imu' or 'mag', stamp) one by one; return all samples."""
    out = []
    for stream, stamp_ns in arrivals:
        if stream == "mag":
            put(pairing, [stamp_ns])
        else:
            out.append(pairing.run(samples([stamp_ns])))
    return joined([*out, pairing.finish()])


def usual(sample_ns):
    """Half the mean of the last 64 intervals that are no gap, at each of ascending samples."""
    reach, known = {}, []
    for before, s in pairwise([sample_ns[0], *sample_ns]):
        known += [s - before] if 0 < s - before <= GAP_NS else []
        reach[s] = sum(known[-64:]) // max(len(known[-64:]), 1) // 2
    return reach.__getitem__
