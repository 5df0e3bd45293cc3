"""What people type: the `pdr` command."""
