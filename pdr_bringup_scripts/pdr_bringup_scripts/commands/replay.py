"""`pdr replay`."""


def replay() -> None:
    """x"""
