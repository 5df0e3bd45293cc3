"""What gait analysis wants to know of a walk: strides in figures, and how the sensor sits on the foot."""

from pdr_core.gait.stride_analysis import StrideAnalysis

__all__ = ["StrideAnalysis"]
