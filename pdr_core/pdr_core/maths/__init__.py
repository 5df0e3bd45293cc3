"""Compiled mathematics that any stage may use."""
