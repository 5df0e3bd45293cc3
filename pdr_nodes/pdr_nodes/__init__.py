"""The ROS 2 nodes of the pedestrian dead reckoning suite."""
