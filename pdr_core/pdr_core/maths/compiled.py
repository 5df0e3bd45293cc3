"""`compiled`: numba's just-in-time compiler with an on-disk cache that notices every change of our code.

numba's own cache does not see that a function called from another file has changed and silently runs the old code
(https://numba.readthedocs.io, "Notes on Caching"). So each module has its folder in the cache, named after a hash of
all sources that it can reach by its imports: a change recompiles what depends on it, and nothing else.
"""

import ast
import hashlib
import os
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import TypeVar, cast

import numba
from numba.core import config
from numba.extending import register_jitable

F = TypeVar("F", bound=Callable)
PACKAGES = Path(__file__).parents[2]  # the folder that holds pdr_core


@cache
def source(module: str) -> Path | None:
    """Return the file of one of our modules, or None."""
    path = PACKAGES.joinpath(*module.split("."))
    files = (path.with_suffix(".py"), path / "__init__.py")
    return next((file for file in files if file.is_file()), None) if module.split(".")[0] == "pdr_core" else None


@cache
def imported(module: str) -> frozenset[str]:
    """Return which of our modules a module imports."""
    file = source(module)
    return frozenset(found(ast.parse(file.read_bytes()))) if file else frozenset()


def found(tree: ast.AST) -> Iterator[str]:
    """Yield our modules that the import statements of a file name; of `from package import module` that module."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if source(alias.name))
        elif isinstance(node, ast.ImportFrom) and node.module:
            for name in node.names:
                inner = f"{node.module}.{name.name}"
                yield from (m for m in (inner if source(inner) else node.module,) if source(m))


def reachable(module: str) -> set[str]:
    """Return a module and all that it imports, directly or not."""
    known, new = set(), {module}
    while new:
        known |= new
        new = {name for m in new for name in imported(m)} - known
    return known


@cache
def cache_folder(module: str) -> Path:
    """Return where the compiled code of this version of a module is kept."""
    base = os.environ.get("PDR_CACHE") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    digest = hashlib.sha256()
    for name in sorted(reachable(module)):
        digest.update(name.encode() + b"\0" + (source(name) or Path(os.devnull)).read_bytes() + b"\0")
    return Path(base) / "pdr" / f"{module}-{digest.hexdigest()[:16]}"


def compiled(function: F) -> F:
    """Compile a function of plain arrays and named tuples; the machine code is kept between processes."""
    before = getattr(config, "CACHE_DIR")  # noqa: B009  (numba sets its options at run time)
    setattr(config, "CACHE_DIR", str(cache_folder(function.__module__)))  # noqa: B010
    try:
        return cast(F, numba.njit(cache=True, error_model="numpy")(function))
    finally:
        setattr(config, "CACHE_DIR", before)  # noqa: B010


def compilable(function: F) -> F:
    """Let compiled code call a function, which Python runs as it is: a call of compiled code would cost it more."""
    return register_jitable(function)
