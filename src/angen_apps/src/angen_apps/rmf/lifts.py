"""An elevator in Open-RMF's words: a lift, which serves one session at a time."""
import re
from dataclasses import dataclass
from typing import Any

from rmf_lift_msgs.msg import LiftRequest, LiftState

from angen_tools.session import State

DOORS = {'CLOSED': LiftState.DOOR_CLOSED, 'OPEN': LiftState.DOOR_OPEN}
MOTIONS = {'UP': LiftState.MOTION_UP, 'DOWN': LiftState.MOTION_DOWN}
MODES = {LiftRequest.REQUEST_AGV_MODE: LiftState.MODE_AGV,
         LiftRequest.REQUEST_HUMAN_MODE: LiftState.MODE_HUMAN}
FLOOR = re.compile(r'floor\s?([0-9]{1,3})', re.IGNORECASE)


def floor_name(floor: int) -> str:
    """As commands call it."""
    return f'Floor{floor}'


@dataclass(frozen=True)
class Session:
    """The session that has the lift, its mode, and the requested floor."""

    name: str
    mode: int
    floor: int


class Lift:
    """An elevator, and the session that has it."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.session: Session | None = None
        self._state: State | None = None
        self._floor: int | None = None  # the last floor at which it stopped

    def take(self, state: State) -> bool:
        """Takes a state; whether a LiftState differs from the one before."""
        before = self.report(None)
        self._state = state
        if state['floor'] >= 0:
            self._floor = state['floor']
        return bool(self.report(None) != before)

    def request(self, message: Any) -> str:
        """Takes a LiftRequest; the command that it comes to, '' where none is needed.

        ValueError where it cannot be served; nothing has changed then.
        """
        if not message.session_id:
            raise ValueError(f'lift {self.name}: a request needs a session_id')
        if self.session is not None and message.session_id != self.session.name:
            raise ValueError(f"lift {self.name}: session '{message.session_id:.80}' has to wait: "
                             f"'{self.session.name:.80}' has it")
        if message.request_type == LiftRequest.REQUEST_END_SESSION:
            self.session = None
            return ''
        if message.request_type not in MODES:
            raise ValueError(f'lift {self.name}: request_type {message.request_type} is none of 0, '
                             '1, 2')
        before = self.session
        self.session = Session(message.session_id, MODES[message.request_type],
                               self._parse(message.destination_floor))
        if before is not None and before.floor == self.session.floor:
            return self.command()
        return floor_name(self.session.floor)

    def command(self) -> str:
        """The command that brings it where its session wants it; '' where it is on the way."""
        if self.session is None or self._state is None \
                or self._state['target_floor'] == self.session.floor:
            return ''
        return floor_name(self.session.floor)

    @property
    def is_standing(self) -> bool:
        """Whether the cabin does not move."""
        return self._state is not None and self._state['mode'] == 'IDLE'

    def _parse(self, text: str) -> int:
        if self._state is None:
            raise ValueError(f'lift {self.name}: it has not reported its floors yet')
        found, floors = FLOOR.fullmatch(text.strip()), self._state['floors']
        if found is None or int(found[1]) >= floors:
            raise ValueError(f"lift {self.name}: there is no floor '{text:.80}', it serves "
                             f'{floor_name(0)} to {floor_name(floors - 1)}')
        return int(found[1])

    def report(self, now: Any) -> Any:
        """The LiftState, None before it is known."""
        state, session = self._state, self.session
        if state is None:
            return None
        return LiftState(
            lift_name=self.name, lift_time=now,
            available_floors=[floor_name(floor) for floor in range(state['floors'])],
            current_floor='' if self._floor is None else floor_name(self._floor),
            destination_floor=floor_name(state['target_floor'] if session is None
                                         else session.floor),
            door_state=DOORS.get(state['door_mode'], LiftState.DOOR_MOVING),
            motion_state=MOTIONS.get(state['mode'], LiftState.MOTION_STOPPED),
            available_modes=[LiftState.MODE_HUMAN, LiftState.MODE_AGV],
            current_mode=LiftState.MODE_HUMAN if session is None else session.mode,
            session_id='' if session is None else session.name)
