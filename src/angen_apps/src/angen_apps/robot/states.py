"""The states of doors and elevators out of their messages."""
from __future__ import annotations

from typing import Any

from angen_apps.robot.interface import DoorState, LiftState

DOOR = ('OPEN', 'CLOSED', 'OPENING', 'CLOSING', 'BLOCKED', 'AJAR')
LIFT = ('IDLE', 'UP', 'DOWN', 'BLOCKED', 'OVERLOADED')
LIFT_DOOR = ('DOOR_OPEN', 'DOOR_CLOSED', 'DOOR_OPENING', 'DOOR_CLOSING', 'DOOR_BLOCKED')


def door_state(message: Any) -> DoorState:
    """The state of an angen_msgs/DoorState."""
    return DoorState(_constant(message, message.mode, DOOR))


def lift_state(message: Any) -> LiftState:
    """The state of an angen_msgs/ElevatorState."""
    door = _constant(message, message.door_mode, LIFT_DOOR)
    return LiftState(_constant(message, message.mode, LIFT), door.removeprefix('DOOR_'),
                     message.target_floor, message.position)


def _constant(message: Any, value: int, names: tuple[str, ...]) -> str:
    """The name of a message's constant."""
    return next((name for name in names if getattr(message, name) == value), '')
