"""The stamp: what the environment was made from; written after each stage, read at each start."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from bootstrap import messages, tf2_msgs
from bootstrap.layout import Layout
from bootstrap.ros import sourced_prefix

EVERYTHING = "everything"
MESSAGES = "messages"

REASONS = {
    "path": "the checkout was moved",
    "ros": "another ROS is sourced than before",
    "requirements": "the required packages have changed",
}


def wanted(layout: Layout, environment: Mapping[str, str]) -> dict[str, str]:
    """Describe what the environment must be made from now."""
    prefix = sourced_prefix(environment, layout)
    fallback = not tf2_msgs.provided(environment if prefix else {}, layout)
    return {
        "path": str(layout.venv),
        "ros": prefix,
        "requirements": digest(layout.bootstrap.glob("requirements-*.txt")),
        "messages": digest(messages.source_files(layout), f"fallback: {fallback}"),
    }


def judge(layout: Layout, environment: Mapping[str, str]) -> tuple[str, str]:
    """Give what must be made (everything, messages or nothing) and the reason in words."""
    stamp = read(layout)
    if not stamp:
        begun = layout.venv.exists()
        return EVERYTHING, "the last set-up did not finish" if begun else "this is the first call"
    now = wanted(layout, environment)
    for key, reason in REASONS.items():
        if stamp.get(key) != now[key]:
            return EVERYTHING, reason
    damage = _damage(layout, stamp)
    if damage:
        return EVERYTHING, damage
    if stamp.get("messages") != now["messages"]:
        return MESSAGES, "the messages have changed"
    gone = _first_missing(stamp["message_files"])
    return (MESSAGES, f"{gone} is missing") if gone else ("", "")


def read(layout: Layout) -> dict[str, Any]:
    """Read the stamp; one that cannot be read counts as none."""
    try:
        stamp = json.loads(layout.stamp.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp if isinstance(stamp, dict) else {}


def write_environment(layout: Layout, now: Mapping[str, str], sourced: bool) -> None:
    """Note that the environment is made; its messages are not built yet."""
    python = os.path.realpath(layout.python)
    contents = [str(path) for path in _landmarks(layout)]
    made = {"sourced": sourced, "python": python, "contents": contents}
    _write(layout, {**now, **made, "messages": "", "message_files": []})


def write_messages(layout: Layout, now: Mapping[str, str]) -> None:
    """Note that the messages are built too."""
    files = [str(path) for path in messages.built_files(layout)]
    _write(layout, {**read(layout), "messages": now["messages"], "message_files": files})


def digest(paths: Iterable[Path], extra: str = "") -> str:
    """Give one hash over the names and contents of these files."""
    total = hashlib.sha256(extra.encode())
    for path in sorted({path for path in paths if path.is_file()}):
        total.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return total.hexdigest()


def _damage(layout: Layout, stamp: Mapping[str, Any]) -> str:
    """Say what of the environment is gone, by looking at files only."""
    gone = _first_missing([stamp["python"], *stamp["contents"]])
    if gone:
        return f"{gone} is missing"
    same = os.path.realpath(layout.python) == stamp["python"]
    return "" if same else "its Python is another one now"


def _first_missing(paths: Iterable[str]) -> str:
    """Give the first of these paths that does not exist."""
    return next((path for path in paths if not os.path.exists(path)), "")


def _landmarks(layout: Layout) -> list[Path]:
    """List what must stay: every installed package with its first module, and Python."""
    passing = ("__pycache__", ".dist-info", ".egg-info")
    packages = [path for path in layout.site_packages.iterdir() if not path.name.endswith(passing)]
    modules = [path / "__init__.py" for path in packages if path.is_dir()]
    return sorted([*packages, *(path for path in modules if path.exists()), layout.python])


def _write(layout: Layout, stamp: Mapping[str, Any]) -> None:
    """Write the stamp at once or not at all."""
    draft = layout.stamp.with_suffix(".draft")
    draft.write_text(json.dumps(stamp, indent=1), encoding="utf-8")
    draft.replace(layout.stamp)
