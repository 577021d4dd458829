"""/angen/home and the rooms of /angen/list."""
from __future__ import annotations

from pathlib import Path
from typing import Iterator

import angen as simulator
import pytest
from angen_msgs.msg import Home as HomeMessage
from angen_msgs.srv import Delete, List, Spawn
from angen_tools.common.home import Home
from geometry_msgs.msg import Pose
from harness import Angen, Inbox, Master, end

ROOM = """<sdf version="1.6"><model name="shed"><static>true</static><link name="l"/>
  <angen:room name="shed"><angen:polygon>0 0 2 0 2 2 0 2</angen:polygon></angen:room>
  <angen:thing>other</angen:thing></model></sdf>"""
WORLD = Path(__file__).resolve().parents[2] / 'worlds/angen.world'


@pytest.fixture(scope='module')
def angen(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
          ) -> Iterator[Angen]:
    """The node with the whole building."""
    log = tmp_path_factory.mktemp('home') / 'log'
    process = master.node(WORLD, log)
    yield Angen(master, process, log)
    end(process)


def test_the_message_is_the_home_of_the_world(angen: Angen) -> None:
    message = Home.of(angen.wait('/angen/home', HomeMessage))
    home = Home.of_world(simulator.World(str(WORLD)))
    assert message.storeys == home.storeys
    assert message.entrance == home.entrance and message.latitude == home.latitude
    assert [room.name for room in message.rooms] == [room.name for room in home.rooms]
    assert [room.area for room in message.rooms] == [room.area for room in home.rooms]
    assert [(door.name, door.rooms) for door in message.doors] == [
        (door.name, door.rooms) for door in home.doors]
    assert [thing.places for thing in message.things if not thing.places] == [
        thing.places for thing in home.things if not thing.places]
    assert [at.room for lift in message.elevators for at in lift.landings] == [
        at.room for lift in home.elevators for at in lift.landings]


def test_it_changes_with_spawn_and_delete(angen: Angen) -> None:
    pose = Pose()
    pose.position.x = 30.0
    with Inbox('/angen/home', HomeMessage) as inbox:
        inbox.wait(lambda message: all(r.name != 'shed' for r in message.rooms), 'no shed')
        assert angen.call('/angen/spawn', Spawn, name='shed', xml=ROOM, pose=pose).success
        message = inbox.wait(lambda m: any(r.name == 'shed' for r in m.rooms), 'the shed')
        shed = next(room for room in message.rooms if room.name == 'shed')
        assert [point.x for point in shed.polygon.points] == [30, 32, 32, 30]
        assert angen.call('/angen/delete', Delete, name='shed').success
        inbox.wait(lambda message: all(r.name != 'shed' for r in message.rooms), 'its end')


def test_each_entity_has_its_room(angen: Angen) -> None:
    rooms = {(entity.kind, entity.name): entity.room
             for entity in angen.call('/angen/list', List).entities}
    assert rooms['pir', 'kitchen_pir0_a'] == 'kitchen0'
    assert rooms['luminosity', 'bathroom_lux1'] == 'bathroom1'
    assert rooms['lamp', 'livingroom1'] == 'livingroom1'
    assert rooms['model', 'ground_plane'] == ''
