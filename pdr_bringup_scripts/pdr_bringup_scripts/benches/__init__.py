"""What `pdr bench` measures, and its tables."""
