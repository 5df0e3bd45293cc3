"""Makes a stream of samples trustworthy: order, gaps, units, mounting, noise."""

from pdr_core.intake.ingestion import Ingestion

__all__ = ["Ingestion"]
