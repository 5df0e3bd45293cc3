"""The `pdr` command (a placeholder until its sub-commands are here)."""

from __future__ import annotations


def main() -> None:
    """Say that there is nothing to run yet."""
    print("pdr 0.1.0")


if __name__ == "__main__":
    main()
