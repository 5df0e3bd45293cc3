"""The set-up behind the `pdr` command; standard library only: it runs before all else."""
