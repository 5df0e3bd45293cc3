"""Pedestrian dead reckoning: the estimators, without ROS."""

__version__ = "0.4.0"
