"""`pdr demo`."""


def demo() -> None:
    """x"""
