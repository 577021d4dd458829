"""A recorded run as pages play it, without ROS."""
import sys
from pathlib import Path
from typing import Any

import angen
import pytest

from angen_apps.web.recording import Recording
from angen_tools.world.models import worlds_models

BOX = '''<sdf version="1.6"><model name="box"><static>true</static><link name="link"><visual
    name="v"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model></sdf>'''


Poses = dict[str, list[float]]


@pytest.fixture(scope='module')
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Poses]:
    """A log of 3 s: the bathroom's door opens at 1 s, and a box is added at 2 s. And the poses of
    links at its end."""
    path = tmp_path_factory.mktemp('run') / 'run.log'
    with angen.World(str(worlds_models().parent / 'angen.world'), 1, str(path)) as world:
        world.run(1.0)
        world.command('door', 'bathroom1', 'Open')
        world.command('lamp', 'kitchen0', 'On')
        world.run(1.0)
        world.spawn(BOX, 'box', [1.0, 2.0, 3.0, 0.0, 0.0, 0.0])
        world.run(1.0)
        return path, dict(zip(world.links, world.link_poses.tolist()))


@pytest.fixture(scope='module')
def read(run: tuple[Path, Poses]) -> tuple[dict[str, Any], list[Any]]:
    """The parts and the entries of its time line."""
    recording = Recording(run[0])
    parts, entries, seen, more = dict[str, Any](), list[Any](), 0, True
    with pytest.MonkeyPatch.context() as patch:
        for name in ('rospy', 'rosgraph', 'genpy', 'angen_msgs'):
            patch.setitem(sys.modules, name, None)
        recording._run()
        assert recording.is_whole()
        while more:
            update = recording.store.since(seen)
            entries += update.parts.pop('timeline', [])
            parts.update(update.parts)
            seen, more = update.version, update.more
    return {**parts, 'drawn': recording.store.scene}, entries


def test_all_that_changes_is_read(run: tuple[Path, Poses],
                                  read: tuple[dict[str, Any], list[Any]]) -> None:
    parts, entries = read
    assert parts['line']['loaded'] == parts['line']['end'] == pytest.approx(3.0)
    assert parts['status'] == {'node': False, 'replay': True}
    assert {room['name'] for room in parts['home']['rooms']} >= {'bathroom1', 'kitchen0'}
    kinds = {entity['kind']: entity for entity in parts['entities']}
    assert kinds['drive']['room'] and {'door', 'lamp', 'pir', 'model'} <= kinds.keys()
    names = {number: f'{link["model"]}::{link["name"]}'
             for number, link in zip(parts['drawn']['ids'], parts['drawn']['links'])}
    last: Poses = {}
    for entry in entries:
        if entry[0] == 'p':
            assert 0.0 <= entry[1] <= 3.0
            last.update({names[number]: entry[3][7 * i:7 * i + 7]
                         for i, number in enumerate(entry[2])})
    assert {'bathroom_door1::door', 'turtlebot::base_footprint'} <= last.keys()
    for name, pose in last.items():
        assert pose == pytest.approx(run[1][name], abs=2e-4), name
    events = [e[2] for e in entries if e[0] == 'e']
    assert ['door', 'bathroom1', 'opening'] in [event[1:4] for event in events]
    assert [event[0] for event in events] == sorted(event[0] for event in events)
    words = [e[4] for e in entries if e[0] == 'r' and e[2:4] == ['door', 'bathroom1'] and e[4]]
    assert words[0].startswith('CLOSED') and any(word.startswith('OPENING') for word in words)
    lamp = parts['drawn']['light_ids'][next(i for i, light in enumerate(parts['drawn']['lights'])
                                            if light['model'] == 'kitchen_lamp0')]
    assert [e[3][e[2].index(lamp)] for e in entries if e[0] == 'l' and lamp in e[2]] == [
        0.0, 1.0, 1.0]  # the last one with the last scene


def test_the_last_scene_has_what_was_added(read: tuple[dict[str, Any], list[Any]]) -> None:
    scene = read[0]['drawn']
    link = next(i for i, one in enumerate(scene['links']) if one['model'] == 'box')
    assert scene['links'][link] == {'model': 'box', 'name': 'link', 'group': 'furniture 0',
                                    'moves': False, 'pose': [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0]}
    shape, = (one for one in scene['shapes'] if one['link'] == link)
    assert (shape['type'], shape['size']) == (0, [1.0, 2.0, 3.0])
