"""Straight lines hold the heading of one foot: Gui section 4.1 and its relatives."""

from pdr_core.heading.constraint import HeadingConstraint

__all__ = ["HeadingConstraint"]
