"""Where estimates of several sensors come together."""

from pdr_core.fusion.watermark import Watermark

__all__ = ["Watermark"]
