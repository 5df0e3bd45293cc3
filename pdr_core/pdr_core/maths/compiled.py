"""`compiled`: numba's just-in-time compiler with an on-disk cache that notices every change of our code.

numba's own cache does not see that a function called from another file has changed and silently runs the old code
(https://numba.readthedocs.io, "Notes on Caching"). So the folder of the cache is named after a hash of all sources.
"""

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar, cast

import numba
from numba.core import config

F = TypeVar("F", bound=Callable)


def sources_hash(root: Path) -> str:
    """Return a short hash of all Python sources below `root`, names and contents."""
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*.py")):
        digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def cache_folder() -> Path:
    """Return where compiled code of this version of pdr_core is kept."""
    base = os.environ.get("PDR_CACHE") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "pdr" / sources_hash(Path(__file__).parents[1])


CACHE_FOLDER = cache_folder()


def compiled(function: F) -> F:
    """Compile a function of plain arrays and named tuples; the machine code is kept between processes."""
    before = getattr(config, "CACHE_DIR")  # noqa: B009  (numba sets its options at run time)
    setattr(config, "CACHE_DIR", str(CACHE_FOLDER))  # noqa: B010
    try:
        return cast(F, numba.njit(cache=True, error_model="numpy")(function))
    finally:
        setattr(config, "CACHE_DIR", before)  # noqa: B010
