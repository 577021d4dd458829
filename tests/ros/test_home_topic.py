"""/angen/home and the rooms of /angen/list."""
from pathlib import Path
import angen as simulator
from angen_msgs.msg import Home as HomeMessage
from angen_msgs.srv import List
from angen_tools.common.home import Home
from harness import Angen, Inbox

ROOM = """<sdf version="1.6"><model name="shed"><static>true</static><link name="l"/>
  <angen:room name="shed"><angen:polygon>0 0 2 0 2 2 0 2</angen:polygon></angen:room>
  <angen:thing>other</angen:thing></model></sdf>"""
WORLD = Path(__file__).resolve().parents[2] / 'worlds/angen.world'


def test_the_message_is_the_home_of_the_world(home: Angen) -> None:
    message = Home.of(home.wait('/angen/home', HomeMessage))
    expected = Home.of_world(simulator.World(str(WORLD)))
    assert message.storeys == expected.storeys
    assert message.entrance == expected.entrance and message.latitude == expected.latitude
    assert [room.name for room in message.rooms] == [room.name for room in expected.rooms]
    assert [room.area for room in message.rooms] == [room.area for room in expected.rooms]
    assert [(door.name, door.rooms) for door in message.doors] == [
        (door.name, door.rooms) for door in expected.doors]
    assert [thing.places for thing in message.things if not thing.places] == [
        thing.places for thing in expected.things if not thing.places]
    assert [at.room for lift in message.elevators for at in lift.landings] == [
        at.room for lift in expected.elevators for at in lift.landings]


def test_it_changes_with_spawn_and_delete(home: Angen) -> None:
    with Inbox('/angen/home', HomeMessage) as inbox:
        inbox.wait(lambda message: all(r.name != 'shed' for r in message.rooms), 'no shed')
        home.spawn('shed', ROOM, 30.0)
        message = inbox.wait(lambda m: any(r.name == 'shed' for r in m.rooms), 'the shed')
        shed = next(room for room in message.rooms if room.name == 'shed')
        assert [point.x for point in shed.polygon.points] == [30, 32, 32, 30]
        home.delete('shed')
        inbox.wait(lambda message: all(r.name != 'shed' for r in message.rooms), 'its end')


def test_each_entity_has_its_room(home: Angen) -> None:
    rooms = {(entity.kind, entity.name): entity.room
             for entity in home.call('/angen/list', List).entities}
    assert rooms['pir', 'kitchen_pir0_a'] == 'kitchen0'
    assert rooms['luminosity', 'bathroom_lux1'] == 'bathroom1'
    assert rooms['lamp', 'livingroom1'] == 'livingroom1'
    assert rooms['model', 'ground_plane'] == ''
