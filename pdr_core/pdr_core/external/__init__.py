"""Somebody else's position of the person: their frame and clock aligned with ours, and what they tell our filter."""
