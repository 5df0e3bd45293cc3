"""What `pdr bench` and `pdr compare` measure: the suite against its simulator, and its detectors on recordings."""
