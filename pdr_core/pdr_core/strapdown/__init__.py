"""One step of inertial navigation."""
