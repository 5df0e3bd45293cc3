"""Walks with a card on the chest, and what is made of them."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.params import ChestParams, Params, SimulationParams
from pdr_core.pipeline import ChestCard
from pdr_core.records import ImuBlock, NavBlock, StepEvent, joined
from pdr_core.simulation import SimulatedWalk, simulated_walk

RATE_HZ = 100


@cache
def walk(
    seed: int, length_m: float = 24.0, sensor: str = "icm_20602", name: str = "rectangle", magnetometer: bool = False
) -> SimulatedWalk:
    """Return a walk, outdoors if the card has a magnetometer; nobody may change it."""
    return simulated_walk(
        SimulationParams(
            motion="chest",
            walk=name,
            walk_length_m=length_m,
            sensor_model=sensor,
            sample_rate_hz=float(RATE_HZ),
            magnetometer=magnetometer,
            seed=seed,
        )
    )


def params(**chest: Any) -> Params:
    """Return the parameters with some of the chest's changed."""
    return Params(chest=replace(ChestParams(), **chest))


def estimated(imu: ImuBlock, chosen: Params | None = None) -> tuple[NavBlock, list[StepEvent], ChestCard]:
    """Return all estimates and steps, and the card that has made them."""
    card = ChestCard(chosen or Params())
    outputs = [card.run(imu), card.finish()]
    return joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps], card


def end_error_m(nav: NavBlock, true: SimulatedWalk) -> float:
    """Return the horizontal distance between the ends."""
    return float(np.linalg.norm((nav.position_m[-1] - true.motion.position_m[-1])[:2]))


def tilt_error_deg(nav: NavBlock, true: SimulatedWalk) -> np.ndarray:
    """Return the error of the level axes, (n, 2)."""
    error = Rotation.from_quat(nav.quat_xyzw) * Rotation.from_quat(true.motion.quat_xyzw).inv()
    return np.degrees(error.as_rotvec()[:, :2])


@cache
def compass_walk() -> tuple[SimulatedWalk, ImuBlock]:
    """Return a walk of 250 m in a clean field, and its samples by a gyro that turns by 0.15 deg/s more after 21 s."""
    true = walk(2, 250.0, name="straight", magnetometer=True)
    up = true.imu.accel_mps2[: 4 * RATE_HZ].mean(axis=0)
    drift = np.radians(0.15) * (true.imu.stamp_ns > 21.0e9)
    return true, true.imu._replace(gyro_radps=true.imu.gyro_radps + drift[:, None] * up / np.linalg.norm(up))
