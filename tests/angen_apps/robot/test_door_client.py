"""Doors and elevators that come and go, in a world in this process."""
from pathlib import Path

import pytest
from harness import WORLD

from angen_apps.robot.door_client import DoorClient, DoorState
from angen_tools.session import World, open_world


@pytest.fixture
def world(tmp_path: Path) -> World:
    path = tmp_path / 'small.world'
    path.write_text(WORLD)
    return open_world(str(path))


@pytest.mark.parametrize('mode, opens, closes', [
    ('OPEN', True, False), ('OPENING', True, False), ('CLOSED', False, True),
    ('CLOSING', False, True), ('AJAR', False, False), ('BLOCKED', True, True)])
def test_a_door_does_a_command(mode: str, opens: bool, closes: bool) -> None:
    state = DoorState(mode)
    assert (state.does('Open'), state.does('Close')) == (opens, closes)
    assert (state.has_done('Open'), state.has_done('Close')) == (mode == 'OPEN', mode == 'CLOSED')


def test_states_follow_commands(world: World) -> None:
    client = DoorClient(world)
    assert list(client.entities) == [('door', 'bathroom0')]
    assert client.door('bathroom0') == DoorState('CLOSED') and client.door('attic') is None
    assert client.follow() == []
    world.command('door', 'bathroom0', 'Open')
    world.run(0.5)
    state, = client.follow()
    assert (state.name, state['mode']) == ('bathroom0', 'OPENING')
    assert client.door('bathroom0') == DoorState('OPENING')


def test_what_is_spawned_is_followed_until_it_is_deleted(world: World) -> None:
    client = DoorClient(world)
    world.spawn('kitchen_door0', 'model://kitchen_door', (5.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    world.spawn('lift', 'model://elevator', (-6.0, 0.0, 0.3, 0.0, 0.0, 0.0))
    world.run(0.1)
    client.follow()
    assert set(client.entities) == {('door', 'bathroom0'), ('door', 'kitchen0'),
                                    ('elevator', 'lift')}
    assert client.door('kitchen0') == DoorState('CLOSED')
    world.delete('kitchen_door0')
    client.follow()
    assert client.door('kitchen0') is None and ('door', 'kitchen0') not in client.entities
