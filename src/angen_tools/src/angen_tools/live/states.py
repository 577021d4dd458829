"""The states of devices in a message, of a topic of their own or of all of a kind."""
from __future__ import annotations

from typing import Any


def states_by_name(message: Any) -> dict[str, Any]:
    """By the name of the device: one state, or with topics:=kind those in an array."""
    if hasattr(message, 'readings'):
        return dict(zip(message.names, message.readings))
    return {message.name: message}
