"""A person who walks from room to room at random and stays a while in each, without activities."""
from __future__ import annotations

import itertools
from typing import Sequence

from angen_apps.residents.chance import chance
from angen_apps.residents.household import Household, Process
from angen_apps.residents.places import Spot
from angen_apps.residents.profiles import Profile
from angen_apps.residents.user import User

STAYS = (10.0, 90.0)  # s at a place
PAUSE = 2.0  # s after a way that was given up
OTHER_STOREY = 0.2  # probability that the next place is on another storey


class Wanderer(User):
    """A resident who walks among `spots`; live() is its process. It appears in another room than
    `avoids`."""

    def __init__(self, household: Household, name: str, profile: Profile, spots: Sequence[Spot],
                 avoids: str = '') -> None:
        super().__init__(household, name, len(household.residents), profile)
        self._spots, self.room = list(spots), avoids
        household.residents.append(self)
        household.add(self.live())

    def live(self) -> Process:
        """Walks and stays until the household ends."""
        for number in itertools.count():
            self._habits = chance(self.household.seed, self.household.name, self.name, 'walks',
                                  number)
            spot, left = self._next(), self.room
            if self.away:
                self.enter(spot)
                self.arrived = True
            else:
                yield from self.go(spot.stand, spot.storey)
                if left != self.room:
                    self._lamp_off(left)
            if self.arrived:
                self._lamps()
            yield self.now + (self._habits.uniform(*STAYS) if self.arrived else PAUSE)

    def _next(self) -> Spot:
        """A place in another room, on the same storey mostly; each room is as probable."""
        others = [spot for spot in self._spots if spot.room != self.room] or self._spots
        if not self.away:
            leaves = self._habits.random() < OTHER_STOREY
            others = [spot for spot in others
                      if (spot.storey != self.storey) == leaves] or others
        room = self._habits.choice(sorted({spot.room for spot in others}))
        return self._habits.choice([spot for spot in others if spot.room == room])
