"""A door in Open-RMF's words."""
from typing import Any

from rmf_door_msgs.msg import DoorMode, DoorState

from angen_apps.robot import door_client
from angen_tools.session import State

VERBS = {DoorMode.MODE_OPEN: 'Open', DoorMode.MODE_CLOSED: 'Close'}


class Door:
    """The last request to a door, and its state."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._state: door_client.DoorState | None = None
        self._requested: int | None = None

    def take(self, state: State) -> bool:
        """Takes a state; whether the door's mode is another one now."""
        before = self.mode
        self._state = door_client.DoorState(state['mode'])
        return self.mode != before

    @property
    def mode(self) -> int | None:
        """The value of DoorMode; None before the first state. A door between its ends, or one that
        is blocked, moves."""
        state = self._state
        return None if state is None else next(
            (mode for mode, verb in VERBS.items() if state.has_done(verb)), DoorMode.MODE_MOVING)

    def request(self, mode: int) -> str:
        """The command of a request, '' where it repeats the present one.

        ValueError where the mode is none that a door can be requested to take.
        """
        if mode not in VERBS:
            raise ValueError(f'door {self.name}: requested_mode {mode} is neither MODE_CLOSED (0) '
                             'nor MODE_OPEN (2)')
        repeated = mode == self._requested and self._state is not None \
            and self._state.does(VERBS[mode])
        self._requested = mode
        return '' if repeated else VERBS[mode]

    def report(self, now: Any) -> Any:
        """The DoorState, None before it is known."""
        if self.mode is None:
            return None
        return DoorState(door_time=now, door_name=self.name, current_mode=DoorMode(self.mode))
