"""Sensors and heating of a home that data comes from."""
from collections import Counter
from pathlib import Path
from random import Random

import numpy as np
import pytest

from angen_apps.data.site import HEATING, Site, apartment
from angen_apps.plan.apartment import apartment as plan
from angen_apps.plan.writer import write_world

CONTACT = ('<include><uri>model://{0}</uri><name>{0}_own</name><pose>2 2 1 0 0 0</pose>'
           '</include>')


@pytest.fixture(name='home')
def home_with_sensors(tmp_path: Path) -> Path:
    """The apartment with sensors of its own, one of them on a door."""
    path = tmp_path / 'home.world'
    apartment(path)
    own = ''.join(CONTACT.format(model)
                  for model in ('luminosity_sensor', 'pir', 'temperature_sensor', 'microphone'))
    path.write_text(path.read_text().replace('</world>', own + '</world>'))
    return path


def kinds_of(site: Site) -> Counter:
    return Counter(kind for kind, _, _, _ in site.world.entities())


def test_sensors_by_rule_replace_those_of_the_world(home):
    site = Site(home, 7)
    kinds = kinds_of(site)
    assert kinds['luminosity'] == kinds['microphone'] == 0
    assert not any(name.endswith('_own') and kind in ('pir', 'temperature')
                   for kind, name, _, _ in site.world.entities())
    assert kinds['temperature'] == sum(room.use != 'landing' for room in site.home.rooms)
    reeds = Counter(model for kind, _, model, _ in site.world.entities() if kind == 'reed')
    assert set(reeds.values()) == {1}  # one each of doors, windows, cabinets
    openers = [(kind, model) for kind, _, model, _ in site.world.entities()
               if kind in ('door', 'window', 'cabinet')]
    assert {model for kind, model in openers if kind != 'door'} <= set(reeds)


def test_no_wardrobe_hides_a_room_from_its_motion_sensor(tmp_path):
    write_world(plan(3, 2, 21), tmp_path / 'home.world')
    site = Site(tmp_path / 'home.world', 7)
    assert kinds_of(site)['temperature'] == 0  # it has no air, of which to read one
    seen = {}
    for room in site.home.rooms:
        place = next((s for s in site.sensors if s.name == f'area_{room.name}'), None)
        if place is None:
            continue
        points = site.floors.spots(room.name, 100, Random(1))
        ways = np.array([(x - place.x, y - place.y, room.floor + 1.2 - place.z)
                         for x, y in points])
        far = np.linalg.norm(ways, axis=1)
        clear = site.world.cast(np.tile((place.x, place.y, place.z), (len(ways), 1)),
                                ways / far[:, None], 20.0)
        seen[room.name] = float((clear > far - 0.2).mean())
    assert len(seen) == 8
    assert min(seen.values()) > 0.8, seen


def test_a_door_that_has_a_contact_gets_no_other(home):
    site = Site(home, 7)
    placed = next(name for kind, name, _, _ in site.world.entities()
                  if (kind, name) == ('reed', 'kitchen0_contact'))
    world = home.with_name('saved.world')
    world.write_text(site.world.save())
    again = Site(world, 7)
    assert sum((kind, name) == ('reed', placed) for kind, name, _, _ in again.world.entities()) == 1


def test_its_own_sensors_stay_where_they_are_asked_for(home):
    kinds = kinds_of(Site(home, 7, placed=False))
    assert kinds['luminosity'] == kinds['pir'] == kinds['microphone'] == 1


def test_the_home_is_heated_unless_its_world_says_to_what(home):
    site = Site(home, 7)
    site.simulator.run(4 * 3600.0)
    air = site.simulator.state('climate', 'apartment0')
    assert air['heating'] == HEATING and air['outside_temperature'] == 5.0
    assert all(HEATING - 1.0 < t < HEATING for t in air['temperatures'])
    site.world.command('climate', 'apartment0', 'Heat 17')
    site.simulator.run(1.0)
    path = home.with_name('cool.world')
    path.write_text(site.world.save())
    cool = Site(path, 7).simulator
    cool.run(1.0)
    assert cool.state('climate', 'apartment0')['heating'] == 17.0
