"""The sources as they lie in the checkout, parsed once."""

import ast
from functools import cache
from pathlib import Path

CHECKOUT = Path(__file__).resolve().parents[2]
PACKAGES = ("pdr_core", "pdr_nodes", "pdr_bringup_scripts")


def python_files() -> list[Path]:
    """Every Python file of the three packages, their set-up and launch files included."""
    found = [path for package in PACKAGES for path in sorted((CHECKOUT / package).rglob("*.py"))]
    return [path for path in found if "build" not in path.relative_to(CHECKOUT).parts]


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


@cache
def modules() -> dict[str, Path]:
    """{dotted name: file} of everything that can be imported from the three packages."""
    found = {}
    for package in PACKAGES:
        top = CHECKOUT / package
        for path in sorted((top / package).rglob("*.py")):
            parts = path.relative_to(top).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def shown(path: Path) -> str:
    return str(path.relative_to(CHECKOUT))
