"""A day's start that is saved and loaded continues unchanged."""
from __future__ import annotations

import angen
import pytest

COMMANDS = [('lamp', 'kitchen0', 'Dim 40'), ('door', 'bathroom0', 'Open'),
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
    after.run(0.001)
    assert after.device('lamp', 'kitchen0')['level'] == 40.0
    before.run(40.0)
    after.run(40.0)
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
