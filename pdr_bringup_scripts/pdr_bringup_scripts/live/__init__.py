"""Live runs: the processes of the nodes, what they say to each other, and the recording of it."""
