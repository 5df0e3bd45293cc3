"""The messages that can be recorded: those of ROS 2 Jazzy, and those whose text is given."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rosbags.typesys.store import Typestore


def known_types(definitions: Mapping[str, str]) -> Typestore:
    """Return the messages of Jazzy and those of `definitions`, which are texts by type."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    types = get_typestore(Stores.ROS2_JAZZY)
    for msgtype, text in definitions.items():
        types.register(get_types_from_msg(text, msgtype))
    return types
