"""A person who is sent somewhere by topic, and by the command line."""
from math import hypot
from typing import Iterator

import pytest
from angen_msgs.msg import Command, PersonState
from harness import WORLD, Angen, Cli, Inbox, Master

BOB = '''<actor name="bob"><script><loop>true</loop><auto_start>true</auto_start>
<trajectory id="0" type="walk">
<waypoint><time>0</time><pose>-4 0 0 0 0 0</pose></waypoint>
<waypoint><time>1000</time><pose>-4 0 0 0 0 0</pose></waypoint>
</trajectory></script></actor>'''


@pytest.fixture(scope="module")
def angen(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
          ) -> Iterator[Angen]:
    """The small world with a standing person in it."""
    world = WORLD.replace("</world>", BOB + "</world>")
    with master.serving(world, tmp_path_factory.mktemp("node"), rate=4) as node:
        yield node


def arrives(person: Inbox, x: float, y: float) -> None:
    def there(state: PersonState) -> bool:
        place = state.pose.position
        return state.mode == PersonState.STANDING and hypot(place.x - x, place.y - y) < 0.1
    person.wait(there, f"it has stopped at {x} {y}")


def test_a_person_goes_where_a_topic_sends_it(angen: Angen) -> None:
    with Inbox("/angen/person/bob", PersonState) as person:
        angen.send("/angen/command", Command(target="bob", text="GoTo -4.5 3"))
        person.wait(lambda m: m.mode == PersonState.WALKING and m.speed > 0.5, "it walks")
        arrives(person, -4.5, 3)


def test_a_person_lies_down_and_gets_up_on_command(angen: Angen, cli: Cli) -> None:
    with Inbox("/angen/person/bob", PersonState) as person:
        cli.does("set", "person", "bob", "lie")
        person.wait(lambda m: m.mode == PersonState.LYING, "it lies")
        angen.send("/angen/command", Command(target="bob", text="Stand"))
        person.wait(lambda m: m.mode == PersonState.STANDING, "it stands")


def test_a_person_goes_where_the_command_line_sends_it(cli: Cli) -> None:
    with Inbox("/angen/person/bob", PersonState) as person:
        cli.does("set", "person", "bob", "goto", "-4", "-1")
        arrives(person, -4, -1)
