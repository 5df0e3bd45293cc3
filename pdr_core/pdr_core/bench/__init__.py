"""What `pdr bench` prints: the parts of the suite against the simulator, as tables of plain records."""
