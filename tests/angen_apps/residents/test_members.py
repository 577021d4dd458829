"""Guests, who ring, come in, eat with their host and leave."""
from __future__ import annotations

import datetime
import math
from dataclasses import replace

import pytest
from angen_apps.data.site import Site, apartment
from angen_apps.residents.agenda import Item, Planner
from angen_apps.residents.household import Household
from angen_apps.residents.members import make
from angen_apps.residents.moods import Day
from angen_apps.residents.profiles import Scheduled, Span, read

DAY = [Item(0.0, 60.0, 'relax', 'free'), Item(60.0, 400.0, 'visit', 'scheduled'),
       Item(400.0, 430.0, 'toilet', 'interrupts'), Item(435.0, 600.0, 'visit', 'continues'),
       Item(600.0, 900.0, 'eat', 'scheduled'), Item(900.0, 86400.0, 'relax', 'free')]


@pytest.mark.parametrize('speed', [0.9, 0.3])  # the host needs 8 or 23 s to the door
def test_a_guest_rings_sits_with_the_host_eats_and_leaves(speed, tmp_path):
    apartment(tmp_path / 'home.world')
    site = Site(tmp_path / 'home.world', 3, placed=False)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23))
    anna, guest = make(household, [('anna', replace(read('retired'), speed=speed))])
    anna.planner.plan = lambda day: DAY
    apart: dict[str, list[float]] = {'visit': [], 'eat': []}

    def heard():
        if anna.posture == guest.posture == 'sit' and anna._doing == guest._doing in apart:
            apart[guest._doing].append(math.dist(anna.at, guest.at))

    household.heard = heard
    household.run(1200.0)
    household.close()
    told = [(i.phase, i.activity, i.posture) for i in guest.diary.closed if i.phase != 'goes']
    assert not any(i.note for i in guest.diary.closed)
    assert told[0] == told[-1] == ('away', 'leave', '')
    assert told[1] == ('waits', 'visit', 'stand')
    does = [(activity, posture) for phase, activity, posture in told if phase == 'does']
    assert does[0] == ('visit', 'sit') and ('eat', 'sit') in does
    waits = next(i for i in guest.diary.closed if i.phase == 'waits')
    assert waits.start == 50.0 and 2.0 < waits.end - waits.start < 40.0  # until anna opens
    assert site.world.device('doorbell', 'entrance_doorbell0')['rings'] == 1
    assert min(map(len, apart.values())) > 0
    assert max(apart['visit'] + apart['eat']) < 3.0
    assert household.now > 1000.0 and guest.away and not anna.away
    anna.planner.plan = lambda day: [replace(DAY[0], activity='leave'), *DAY[1:]]  # is out before
    assert [(item.activity, item.start) for item in guest._items(0)] == [
        ('leave', 0.0), ('visit', 70.0), ('eat', 600.0), ('leave', 900.0)]


def test_a_resident_has_as_many_guests_as_its_range_says():
    profile = replace(read('worker'), guests=(1.5, 1.5))
    days = [Day(n, datetime.date(2026, 3, 23) + datetime.timedelta(n)) for n in range(210)]
    visits = sum(item.activity == 'visit' and item.cause == 'scheduled' for seed in range(3)
                 for day in days for item in Planner(seed, 'home', 'anna', profile).plan(day))
    assert 1.0 < visits / 90 < 1.8  # a week; illness and weather prevent some
    for alone in (replace(profile, guests=(0.0, 0.0)),
                  replace(profile, scheduled=(Scheduled(('visit',), Span(6e4, 6e4), chance=0.0),))):
        never = Planner(1, 'home', 'anna', alone)
        assert not any(item.activity == 'visit' for day in days for item in never.plan(day))
