"""Names of things."""
import pytest
from angen_apps.mqtt.naming import area, distinct, label, slug

from tests.angen_apps.mqtt.fakes import home


@pytest.mark.parametrize('kind, name, floors, expected', [
    ('lamp', 'kitchen0', 2, 'Kitchen lamp'), ('lamp', 'kitchen1', 2, 'Upstairs kitchen lamp'),
    ('lamp', 'kitchen2', 3, 'Floor 2 kitchen lamp'), ('lamp', 'lamp7', 2, 'Lamp 7'),
    ('pir', 'bedroom_pir0_b', 2, 'Bedroom motion sensor B'),
    ('appliance', 'livingroom_tv0', 2, 'Living room TV'),
    ('reed', 'kitchen_window0', 2, 'Kitchen window contact'),
    ('elevator', 'elevator', 2, 'Elevator'),
    ('rfid', 'rfid', 1, 'Rfid RFID reader'), ('sprinkler', 'lawn', 1, 'Lawn sprinkler'),
    ('lamp', 'a\nbc', 1, 'A bc lamp'), ('lamp', 'bedroom2', 2, 'Bedroom 2 lamp'),
    ('lamp', '&', 1, '& lamp'), ('lamp', '__', 1, 'Lamp'), ('lamp', 'x' * 300, 1, 'X' + 99 * 'x')])
def test_a_label_is_what_people_say(kind: str, name: str, floors: int, expected: str) -> None:
    assert label(kind, name, home(floors)) == expected


def test_areas_are_rooms() -> None:
    assert area('livingroom0', home(2)) == 'Living room'
    assert area('livingroom1', home(2)) == 'Upstairs living room'


def test_labels_are_distinct() -> None:
    assert distinct([('Lamp', 'lamp a'), ('Lamp', 'lamp A'), ('Door', 'door d')]) == [
        'Lamp (lamp a)', 'Lamp (lamp A)', 'Door']


def test_slugs_of_different_names_differ() -> None:
    names = ['a b', 'a/b', 'a+b', 'ü', 'a_b', 'a-b']
    assert len({slug(name) for name in names}) == len(names)
    assert slug('ü') == '_xc3_xbc'
