"""The output of angen list."""
import json

import pytest

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import quaternion
from angen_tools.common.output import plain
from angen_tools.live import listing
from angen_tools.session import Entity


def entity(name: str, kind: str, topic: str) -> Entity:
    pose = (1.0, -1e-9, 0.25, *quaternion(0.0, 0.0, 1.5))
    return Entity(kind, name, 'hall', pose, 'living0', topic, 't')


class Simulator:
    """A client of a simulator with a door and a PIR."""

    def entities(self) -> list[Entity]:
        return [entity('hall0', 'door', '/angen/door/hall0'), entity('eye', 'pir', '/eye')]


@pytest.fixture(autouse=True)
def simulator(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(listing, 'Live', Simulator)


def test_a_row_has_place_and_topic() -> None:
    lines = plain(listing.list_entities('pir', False)).splitlines()
    assert [line.split() for line in lines] == [
        ['NAME', 'KIND', 'MODEL', 'ROOM', 'X', 'Y', 'Z', 'YAW', 'TOPIC'],
        ['eye', 'pir', 'hall', 'living0', '1', '0', '0.25', '1.5', '/eye']]


def test_json_has_every_digit() -> None:
    door, eye = json.loads(str(listing.list_entities('', True)))
    assert (door['name'], eye['name']) == ('hall0', 'eye')
    assert door['room'] == 'living0'
    assert door['pose']['position'] == [1.0, -1e-9, 0.25]


def test_a_kind_without_entities_is_empty_and_an_unknown_one_is_an_error() -> None:
    assert json.loads(str(listing.list_entities('lamp', True))) == []
    with pytest.raises(Failure, match="no kind 'dor'; did you mean door"):
        listing.list_entities('dor', False)
