"""Doors and elevators, as the programs of robots use them."""
from contextlib import suppress
from dataclasses import dataclass

from angen_tools.common.failure import Failure
from angen_tools.session import Entity, State, World

KINDS = ('door', 'elevator')
CHANGES = ('spawned', 'deleted')
# the modes in which a door has done a command, or does what it can
DONE = {'Open': 'OPEN', 'Close': 'CLOSED'}
DOES = {'Open': ('OPEN', 'OPENING', 'BLOCKED'), 'Close': ('CLOSED', 'CLOSING', 'BLOCKED')}


@dataclass(frozen=True)
class DoorState:
    """The mode of a door, whose commands are Open and Close."""

    mode: str

    def has_done(self, verb: str) -> bool:
        return self.mode == DONE[verb]

    def does(self, verb: str) -> bool:
        """Whether a command would change nothing."""
        return self.mode in DOES[verb]


class DoorClient:
    """The doors and elevators of a world, as they come and go, and their states."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.entities: dict[tuple[str, str], Entity] = {}
        self.states: dict[tuple[str, str], State] = {}
        self.is_stale = True  # something may have come or gone
        self.follow()

    def follow(self) -> list[State]:
        """Takes the new states."""
        if any(event.event in CHANGES for event in self.world.events()):
            self.is_stale = True
        new: list[State] = []
        with suppress(Failure):  # the simulator ends, or begins
            new = self.world.states(*KINDS)
            if self.is_stale:
                found = [entity for kind in KINDS for entity in self.world.entities(kind)]
                self.entities = {(entity.kind, entity.name): entity for entity in found}
                self.states = {key: state for key, state in self.states.items()
                               if key in self.entities}
                self.is_stale = False
        self.states.update(((state.kind, state.name), state) for state in new)
        return new

    def door(self, name: str) -> DoorState | None:
        """The state of a door; None before the first."""
        state = self.states.get(('door', name))
        return None if state is None else DoorState(state['mode'])
