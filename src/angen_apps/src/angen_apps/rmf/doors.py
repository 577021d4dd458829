"""A door in Open-RMF's words."""
from __future__ import annotations

from typing import Any

from angen_msgs.msg import DoorState as State
from rmf_door_msgs.msg import DoorMode, DoorState

# A door between its ends, or one that is blocked, is neither open nor closed.
MODES = {State.CLOSED: DoorMode.MODE_CLOSED, State.OPEN: DoorMode.MODE_OPEN,
         State.OPENING: DoorMode.MODE_MOVING, State.CLOSING: DoorMode.MODE_MOVING,
         State.BLOCKED: DoorMode.MODE_MOVING, State.AJAR: DoorMode.MODE_MOVING}
VERBS = {DoorMode.MODE_OPEN: 'Open', DoorMode.MODE_CLOSED: 'Close'}
# Modes in which a door already does its request.
DONE = {DoorMode.MODE_OPEN: (State.OPEN, State.OPENING, State.BLOCKED),
        DoorMode.MODE_CLOSED: (State.CLOSED, State.CLOSING, State.BLOCKED)}


class Door:
    """The last request to a door, and its state."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._state: Any = None
        self._requested: int | None = None

    def take(self, state: Any) -> bool:
        """Takes an angen_msgs/DoorState; whether the door's mode is another one now."""
        before = self.mode
        self._state = state
        return self.mode != before

    @property
    def mode(self) -> int | None:
        """The value of DoorMode; None before the first state."""
        return None if self._state is None else MODES[self._state.mode]

    def request(self, mode: int) -> str:
        """The command of a request, '' where it repeats the present one.

        ValueError where the mode is none that a door can be requested to take.
        """
        if mode not in VERBS:
            raise ValueError(f'door {self.name}: requested_mode {mode} is neither MODE_CLOSED (0) '
                             'nor MODE_OPEN (2)')
        repeated = mode == self._requested and self._state is not None \
            and self._state.mode in DONE[mode]
        self._requested = mode
        return '' if repeated else VERBS[mode]

    def report(self, now: Any) -> Any:
        """The DoorState, None before it is known."""
        if self.mode is None:
            return None
        return DoorState(door_time=now, door_name=self.name, current_mode=DoorMode(self.mode))
