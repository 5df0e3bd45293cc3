"""What `pdr run` makes of a recording: who runs, what is kept, which files."""
