"""Pedestrian dead reckoning: the estimators, without ROS."""

__version__ = "0.9.0"
