"""What `pdr compare` measures on recordings."""
