"""The members of a household, and their guests, who live elsewhere."""
from __future__ import annotations

import sys
from dataclasses import replace
from typing import Any

from angen_apps.residents.agenda import VISIT, Item
from angen_apps.residents.company import EAT, Process
from angen_apps.residents.household import Household
from angen_apps.residents.profiles import Profile
from angen_apps.residents.resident import COOK, Resident
from angen_tools.common.failure import Failure

RINGS = 10.0  # s before the host goes to the door, or after the host has come home
LETS_IN = 300.0  # s until a guest to whom nobody opens goes away


class Guest(Resident):
    """The visitor of a resident, the host: rings, waits at the door, sits and eats with the host.
    """

    def __init__(self, household: Household, host: Resident) -> None:
        self.host = host
        super().__init__(household, f'guest_of_{host.name}', len(household.residents), replace(
            host.profile, name='guest', lives=False, scheduled=(), free={}, needs={},
            does=frozenset((VISIT, EAT))))
        for name in (VISIT, EAT):  # a guest stays seated
            self._known[name] = replace(self._known[name], visits=None)
        visit = self._known[VISIT]  # the first step is the host's, at the door
        self._known[VISIT] = replace(visit, steps=visit.steps[1:])
        self._tasks[VISIT] = self._tasks[VISIT][1:]

    def _items(self, number: int) -> list[Item]:
        """Elsewhere, but for the host's visits and the meals that follow or interrupt them."""
        found: list[Item] = []
        before = ''
        for item in self.host.planner.plan(self.household.day(number)):
            stays = bool(found) and found[-1].activity != 'leave' and (
                item.activity in (VISIT, COOK, EAT) if item.cause == 'scheduled'
                else item.cause != 'free')
            does = EAT if stays and item.activity == EAT else \
                VISIT if stays or item.activity == VISIT else 'leave'
            if found and found[-1].activity == does:
                found[-1] = replace(found[-1], end=item.end)
            else:
                start = item.start if stays or does == 'leave' else \
                    item.start + (RINGS if before == 'leave' else -RINGS)
                found[-1:] = [replace(last, end=start) for last in found[-1:]]
                found.append(Item(start, item.end, does, 'scheduled'))
            before = item.activity
        return found

    def _come(self) -> Process:
        """Rings, and waits until somebody opens."""
        if not self.away:
            return
        yield from super()._come()
        self._note('waits', self.item.activity)
        self.household.ring(self.name)
        until, door = self.now + LETS_IN, self.floors.entrance()
        while door and self.simulator.state('door', door.name).get('mode') == 'CLOSED':
            if self.now > until:
                self.diary.note('nobody opened')
                self.vanish()
                self._note('away', 'leave')
                return
            yield self.now + 1.0
        self._note('goes', self.item.activity)


def make(household: Household, who: list[tuple[str, Profile]], strict: bool = False) -> list[Any]:
    """The residents of a household and their guests, whose days begin. Says what residents cannot
    do in their home; Failure for that if `strict`."""
    for number, (name, profile) in enumerate(who):
        household.residents.append(Resident(household, name, number, profile))
    remarks = [remark for resident in household.residents for remark in resident.remarks()]
    for remark in remarks:
        print(f'angen: {remark}', file=sys.stderr, flush=True)
    if strict and remarks:
        raise Failure(f'residents cannot live in {household.name} as they do elsewhere: '
                      f'{len(remarks)} remarks')
    planners = [resident.planner for resident in household.residents if resident.profile.lives]
    for host in household.residents[:]:
        if VISIT in host.profile.does and VISIT not in host.leaves_out \
                and household.floors.porch() is not None:
            household.residents.append(Guest(household, host))
    for resident in household.residents:
        resident.planner.table = planners
        household.add(resident.live())
    return household.residents
