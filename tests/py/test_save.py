"""A day's start that is saved and loaded continues unchanged."""
import subprocess
import sys

import angen
import numpy as np
import pytest
from lxml import etree
from sdf_text import WORLDS

COMMANDS = [('lamp', 'bathroom1', 'Dim 40'), ('door', 'bathroom0', 'Open'),
            ('elevator', 'elevator', 'Floor1')]


def test_the_building_continues_as_it_was(building: str) -> None:
    before = angen.World(building)
    names = {(kind, name) for kind, name, _ in COMMANDS if name in before.devices(kind)}
    assert len(names) == len(COMMANDS)
    before.run(1.0)
    for kind, name, text in COMMANDS:
        before.command(kind, name, text)
    before.run(3.0)
    after = angen.World.from_text(before.save())
    assert after.models == before.models
    moved = np.abs(after.link_poses[:, :3] - before.link_poses[:, :3]).max(axis=1)
    people = [i for i, name in enumerate(before.links) if name.startswith('person')]
    assert np.delete(moved, people).max() < 1e-3
    after.run(0.001)
    assert after.device('lamp', 'bathroom1')['level'] == 40.0
    before.run(30.0)
    after.run(30.0)
    for kind, name in names:
        assert after.device(kind, name).get('mode') == before.device(kind, name).get('mode'), name
    assert after.device('elevator', 'elevator')['floor'] == 1
    assert after.light_levels == pytest.approx(before.light_levels)
    for person in before.devices('person'):
        one, other = after.device('person', person), before.device('person', person)
        assert one['x'] == pytest.approx(other['x'], abs=0.15), person
        assert one['y'] == pytest.approx(other['y'], abs=0.15), person


def test_a_world_that_was_saved_and_loaded_is_saved_the_same(building: str) -> None:
    first = angen.World(building)
    text = first.save()
    assert angen.World.from_text(text).save() == angen.World.from_text(
        angen.World.from_text(text).save()).save()


def test_sensors_spawned_on_a_model_keep_their_names_and_leave_others_theirs() -> None:
    model = ('<model name="shelf"><static>true</static><link name="l"><sensor name="own" '
             'type="ray"><plugin name="p" filename="libpir_controller.so"/></sensor></link>'
             '</model>')
    world = angen.World.from_text(f'<sdf version="1.9"><world name="w">{model}</world></sdf>')
    assert [name for kind, name, *_ in world.entities() if kind == 'pir'] == ['shelf']
    for name in ('p1', 'p2'):
        world.spawn('<sensor name="s" type="ray"><plugin name="p" filename="libpir_controller.so"/>'
                    '</sensor>', name, on='shelf::l')
    for _ in range(2):
        world = angen.World.from_text(world.save())
        names = {name for kind, name, *_ in world.entities() if kind == 'pir'}
        assert names == {'shelf', 'p1', 'p2'}


def test_three_apartments_from_the_empty_world() -> None:
    """Storey by storey, with the doors that make_worlds.py lists."""
    doors = subprocess.run([sys.executable, str(WORLDS / 'make_worlds.py'), '--list-doors',
                            '--floor', '0'], text=True, capture_output=True, check=True).stdout
    world = angen.World(str(WORLDS / 'empty.world'))
    for floor in range(3):
        world.spawn('model://apartment', f'apartment{floor}', [0, 0, 4 * floor, 0, 0, 0])
        for line in doors.splitlines():
            uri, name, pose = line.split(' ', 2)
            x, y, _, *turn = map(float, pose.strip('"').split())
            world.spawn(uri, f'{name[:-1]}{floor}', [x, y, 4 * floor, *turn])
    assert len(world.devices('door')) == 18 and 'kitchen2' in world.devices('door')
    world.command('door', 'kitchen2', 'Open')
    world.spawn('model://elevator', 'elevator', [-3.65, 5, 0, 0, 0, 0])
    world.command('elevator', 'elevator', 'Floor1')
    with pytest.raises(angen.Error, match='Floor0 to Floor1'):
        world.command('elevator', 'elevator', 'Floor2')
    saved = world.save()
    assert len(etree.fromstring(saved.encode()).xpath('world/include')) == 22
    assert len(angen.World.from_text(saved).models) == 23  # and the ground


def test_a_static_model_that_was_put_elsewhere_is_saved_there(building: str) -> None:
    world = angen.World(building)
    before = pose_texts(world.save())
    world.set_state('kitchen_pir0_a', [1.0, 1.5, 2.0, 0.0, 0.25, 1.0])
    world.run(0.01)
    place = world.motion('kitchen_pir0_a')[0]
    saved = world.save()
    again = angen.World.from_text(saved)
    again.run(0.01)
    assert again.motion('kitchen_pir0_a')[0] == pytest.approx(place, abs=1e-6)
    after = pose_texts(saved)
    assert [name for name, text in after.items() if before[name] != text
            and 'pir' in name] == ['kitchen_pir0_a']


def pose_texts(world: str) -> dict[str, str]:
    """The poses of included models, by name."""
    return {block.findtext('name'): block.findtext('pose')
            for block in etree.fromstring(world.encode()).iterfind('world/include')}
