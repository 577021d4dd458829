"""A resident's use of a home's devices: fronts, the stove, the TV, lamps."""
from __future__ import annotations

from typing import Iterator

from angen_apps.residents.activities import Step
from angen_apps.residents.agenda import Item
from angen_apps.residents.household import Household
from angen_apps.residents.mover import Mover
from angen_apps.residents.places import Spot
from angen_apps.residents.profiles import Profile
from angen_tools.common.home import Thing

TV = 'watch_tv'
DARK = 50.0  # lx: with less, lamps are switched on

Process = Iterator[float]


class User(Mover):
    """A body that uses devices during an item of its agenda."""

    def __init__(self, household: Household, name: str, number: int, profile: Profile) -> None:
        super().__init__(household, name, number, profile)
        self.item = Item(0.0, 0.0, 'sleep', 'scheduled')

    def _use(self, step: Step, spot: Spot) -> list[tuple[str, str, str]] | None:
        """Opens or switches on the devices of a step; returns how to undo it."""
        if self.profile.body != 'person':
            return None
        household = self.household
        thing = self._thing(spot)
        if step.opens == 'entrance':
            entrance = self.floors.entrance()
            if entrance and household.do(self.name, 'door', entrance.name, 'OpenByHand'):
                return [('door', entrance.name, 'CloseByHand')]
        elif step.opens and thing is not None:
            front = self.floors.fronts.of(thing)
            if front and household.do(self.name, 'cabinet', front, 'OpenByHand'):
                return [('cabinet', front, 'Close')]
        elif step.runs == 'stove' and thing is not None:
            stove = household.of_model(thing.name, 'stove')
            if stove and household.do(self.name, *stove, 'FrontLeft 60'):
                return [(*stove, 'Off')]
        elif step.runs == 'tv':
            return self._watch()
        return None

    def _thing(self, spot: Spot) -> Thing | None:
        return next((t for t in self.household.home.things if t.name == spot.thing), None)

    def _watch(self) -> list[tuple[str, str, str]] | None:
        sets = [t for t in self.household.home.things if t.type == 'tv']
        near = next((t for t in sets if t.room == self.room), sets[0] if sets else None)
        screen = near and self.household.of_model(near.name, 'appliance')
        if not screen:
            return None
        self.household.do(self.name, *screen, 'On')
        return [(*screen, 'Off')]

    def _unuse(self, used: list[tuple[str, str, str]] | None) -> None:
        for kind, name, text in used or ():
            if kind == 'appliance' and self._somebody_watches():
                continue
            self.household.do(self.name, kind, name, text)

    def _somebody_watches(self) -> bool:
        return any(r is not self and r.item.activity == TV and not r.away
                   for r in self.household.residents)

    def _lamps(self, dark: bool = False) -> None:
        """Switches the room's lamps by how light it is, and by habit; off where it has to be dark.
        """
        household, room = self.household, self.room
        if self.profile.body != 'person' or room not in household.lamps:
            return
        if dark:
            self._lamp_off(room)
        elif household.lux(room) < DARK and self._habits.random() < self.profile.lamps_on:
            for lamp in household.lamps[room]:
                household.do(self.name, 'lamp', lamp, 'On')

    def _lamp_off(self, room: str) -> None:
        household = self.household
        if self.profile.body != 'person' or household.others_in(room, self.name):
            return
        for lamp in household.lamps.get(room, ()):
            if household.simulator.state('lamp', lamp).get('on') \
                    and self._habits.random() < self.profile.lamps_off:
                household.do(self.name, 'lamp', lamp, 'Off')
