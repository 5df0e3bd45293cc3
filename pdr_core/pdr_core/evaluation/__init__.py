"""Judging a track: alignment, metrics with units, result, pictures, report."""
