"""Simulated walks: true motion and the sensor that feels it."""

from pdr_core.simulation.walk import SimulatedWalk, simulated_feet, simulated_walk, walk_duration_s

__all__ = ["SimulatedWalk", "simulated_feet", "simulated_walk", "walk_duration_s"]
