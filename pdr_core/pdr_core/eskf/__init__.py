"""The error-state Kalman filter of one foot."""

from pdr_core.eskf.zupt_filter import ZuptFilter

__all__ = ["ZuptFilter"]
