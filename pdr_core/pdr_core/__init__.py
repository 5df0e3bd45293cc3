"""Pedestrian dead reckoning: the estimators, without ROS."""

__version__ = "0.10.0"
