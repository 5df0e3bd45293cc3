"""The orientation of one foot, without its position."""

from pdr_core.attitude.quaternion_filter import QuaternionFilter, UnjudgedQuaternionFilter

__all__ = ["QuaternionFilter", "UnjudgedQuaternionFilter"]
