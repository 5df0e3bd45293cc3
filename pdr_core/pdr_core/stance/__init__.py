"""Judges whether the foot stands."""

from pdr_core.stance.detection import StanceDetection

__all__ = ["StanceDetection"]
