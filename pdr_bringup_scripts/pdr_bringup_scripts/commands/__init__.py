"""One file per sub-command; heavy imports happen when a command runs."""
