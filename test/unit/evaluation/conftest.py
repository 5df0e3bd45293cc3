"""A made-up walk round a rectangle, for the tests of the evaluation: nothing here comes from a filter."""

from types import SimpleNamespace

import numpy as np
import pytest

from pdr_core.evaluation.result import Result
from pdr_core.records import Level, NavBlock, Notice, StanceBlock, StepEvent, inertial_block
from pdr_core.records_gait import CYCLE_POINTS, Stride

PERIOD_NS = 10_000_000  # 100 Hz
STRIDE_SAMPLES, STANCE_SAMPLES = 120, 50


def nav_block(stamp_ns, position_m, yaw_rad=0.0, covariance=None):
    n = len(stamp_ns)
    half = np.broadcast_to(np.asarray(yaw_rad) / 2, n)
    quat = np.column_stack([np.zeros(n), np.zeros(n), np.sin(half), np.cos(half)])
    pose = np.zeros((n, 6, 6))
    if covariance is not None:
        pose[:, :3, :3] = covariance
    position_m = np.asarray(position_m, dtype=float).reshape(n, -1)
    position_m = np.pad(position_m, ((0, 0), (0, 3 - position_m.shape[1])))
    stamps = np.asarray(stamp_ns, dtype=np.int64)
    return NavBlock(stamps, position_m, quat, np.zeros((n, 3)), np.zeros((n, 3)), pose, np.zeros((n, 3, 3)))


def stance_block(stamp_ns, stance, statistic=None):
    n, stamps = len(stamp_ns), np.asarray(stamp_ns, dtype=np.int64)
    imu = inertial_block(stamps, np.zeros((n, 3)), np.zeros((n, 3)), np.zeros(n), np.zeros(n))
    statistic = np.where(stance, 5.0, 500.0) if statistic is None else np.asarray(statistic, dtype=float)
    return StanceBlock(
        imu, np.asarray(stance, dtype=bool), statistic, np.full(n, 30.0), np.zeros(n), np.zeros((n, 3)), np.zeros(n)
    )


def steps_at(position_m, stamp_ns=None):
    """Steps that end at rows 1, 2 ... of positions whose row 0 is the start."""
    position_m = np.asarray(position_m, dtype=float)
    position_m = np.pad(position_m, ((0, 0), (0, 3 - position_m.shape[1])))
    stamps = np.arange(len(position_m)) * 10**9 if stamp_ns is None else stamp_ns
    return [
        StepEvent(
            index=i,
            start_ns=int(stamps[i - 1]),
            stamp_ns=int(stamps[i]),
            position_m=position_m[i],
            displacement_m=position_m[i] - position_m[i - 1],
            displacement_covariance_m2=np.diag([4e-4, 4e-4, 1e-4]),
            yaw_rad=0.0,
            yaw_sd_rad=0.01,
        )
        for i in range(1, len(position_m))
    ]


def strides_of(steps, cycles=True):
    """Steps in figures: the first does not know what came before it, the last ends in a pause."""
    course_rad = np.radians(50.0) * np.sin(np.linspace(0.0, 2.0 * np.pi, CYCLE_POINTS))
    return [
        Stride(
            step,
            duration_s=None if step is steps[-1] else 1.2,
            stance_s=None if step is steps[-1] else 0.75,
            swing_s=0.45,
            clearance_m=0.12,
            turn_rad=0.1,
            heading_change_rad=None if step is steps[0] else 0.1,
            toe_off_ns=step.start_ns + 150_000_000,
            heel_strike_ns=step.start_ns + 600_000_000,
            pitch_max_rad=0.9,
            pitch_min_rad=-0.35,
            pitch_cycle_rad=course_rad if cycles and step is not steps[-1] else None,
        )
        for step in steps
    ]


def rectangle(stride_m=1.4, strides=(8, 5, 8, 5), start_ns=1_700_000_000_000_000_000):
    """Walk once round a rectangle and return the true motion, its stances and an estimate that drifts."""
    rng = np.random.default_rng(7)
    headings = np.repeat(np.arange(4) * np.pi / 2, strides)
    steps_m = stride_m * np.column_stack([np.cos(headings), np.sin(headings)])
    footfall_m = np.vstack([[0.0, 0.0], np.cumsum(steps_m, axis=0)])
    swing = np.linspace(0, 1, STRIDE_SAMPLES - STANCE_SAMPLES, endpoint=False)
    phase = np.concatenate([np.zeros(STANCE_SAMPLES), 0.5 - 0.5 * np.cos(np.pi * swing)])
    lift = np.concatenate([np.zeros(STANCE_SAMPLES), 0.12 * np.sin(np.pi * swing) ** 2])
    xy = (footfall_m[:-1, None] + phase[None, :, None] * steps_m[:, None]).reshape(-1, 2)
    true_m = np.column_stack([xy, np.tile(lift, len(steps_m))])
    true_m = np.vstack([true_m, np.tile([*footfall_m[-1], 0.0], (STANCE_SAMPLES, 1))])
    n = len(true_m)
    stamp_ns = start_ns + np.arange(n) * PERIOD_NS
    stance = np.concatenate([np.tile(np.arange(STRIDE_SAMPLES) < STANCE_SAMPLES, len(steps_m)), np.ones(50, bool)])
    ends = np.append(np.arange(len(steps_m)) * STRIDE_SAMPLES + STANCE_SAMPLES - 1, n - 1)

    drift_rad = np.linspace(0, 0.05, n)
    cosine, sine = np.cos(drift_rad), np.sin(drift_rad)
    moves = np.diff(true_m, axis=0, prepend=true_m[:1])
    turned = np.column_stack([cosine * moves[:, 0] - sine * moves[:, 1], sine * moves[:, 0] + cosine * moves[:, 1]])
    estimate_m = np.column_stack([np.cumsum(turned, axis=0), true_m[:, 2] - np.linspace(0, 0.15, n)])
    statistic = np.where(stance, 4.0, 4e3) * np.exp(rng.normal(0, 0.5, n))
    sd_m = np.linspace(0.002, 0.3, n)[:, None, None]
    covariance = sd_m**2 * np.array([[1.0, 0.4, 0], [0.4, 0.6, 0], [0, 0, 0.5]])
    nav = nav_block(
        stamp_ns, estimate_m, np.repeat(headings, STRIDE_SAMPLES)[np.minimum(np.arange(n), n - 51)], covariance
    )
    judged = stance_block(stamp_ns, stance, statistic)
    measured_m = true_m + rng.normal(0, 2e-4, true_m.shape)
    steps = steps_at(estimate_m[ends], stamp_ns[ends])
    return SimpleNamespace(
        nav=nav,
        judged=judged,
        steps=steps,
        strides=strides_of(steps),
        stamp_ns=stamp_ns,
        true_m=measured_m,
        footfall_m=true_m[ends, :2],
    )


def result_of(**changes):
    """A result with every field set; changes replace fields."""
    fields = {
        "recording": "corridor.csv",
        "format": "csv",
        "samples": 201,
        "duration_s": 100.0,
        "pipeline": "foot_inertial",
        "smoothed": False,
        "two_passes": False,
        "strides": 52,
        "distance_m": 98.44,
        "end_position_m": np.array([1.0, 2.0, 3.0]),
        "closure_2d_m": 2.236,
        "closure_3d_m": 3.742,
        "gait": None,
        "seconds": 0.25,
        "notices": [Notice(Level.WARN, "gap", "The sensor was silent for 0.3 s", 3, 0)],
        "config": {"stance": {"window_s": 0.035}},
        "truth": None,
        "version": "1.0.0",
        "commit": "0123abc",
    }
    return Result(**{**fields, **changes})


@pytest.fixture(scope="session")
def make():
    """The makers above, by name."""
    return SimpleNamespace(
        nav_block=nav_block,
        stance_block=stance_block,
        steps_at=steps_at,
        strides_of=strides_of,
        rectangle=rectangle,
        result_of=result_of,
    )
