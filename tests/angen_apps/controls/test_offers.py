"""Menus and clicks follow the verbs of the kinds."""
from types import SimpleNamespace

import pytest
from angen_apps.controls.offers import SEND, offers, pair, toggled, walk

from angen_tools.common.catalog import kinds

ROOMS = ['kitchen0', 'hall0']


def texts(kind: str, *floors: int) -> list[str]:
    return [offer.text for offer in offers(kinds()[kind], floors)]


def test_menus_have_verbs_floors_and_percents() -> None:
    assert texts('lamp') == ['On', 'Off', 'Dim 0', 'Dim 25', 'Dim 50', 'Dim 75', 'Dim 100']
    assert texts('elevator', 0, 1, 2) == ['Floor0', 'Floor1', 'Floor2']
    assert texts('door')[:2] == ['Open', 'Close']


def test_each_text_is_a_command_of_its_kind() -> None:
    from angen_tools.common.verbs import parse
    for kind in kinds('device').values():
        for offer in offers(kind, [0, 1], ROOMS):
            assert offer.under == SEND or parse(kind, offer.text.split()).verb


def test_people_and_robots_are_sent_to_rooms() -> None:
    def sent(kind: str) -> list[str]:
        return [o.label for o in offers(kinds()[kind], (), ROOMS) if o.under == SEND]

    assert sent('person') == sent('drive') == ROOMS
    assert walk(kinds()['person']) == 'GoTo' and not walk(kinds()['drive'])
    assert not sent('lamp') and not sent('elevator')


@pytest.mark.parametrize('state, verb', [
    (SimpleNamespace(target=0.0), 'Open'), (SimpleNamespace(target=-1.57), 'Close'),
    (SimpleNamespace(target=1.2), 'Close'), (None, 'Open')])
def test_a_click_on_a_door_changes_it(state: object, verb: str) -> None:
    assert toggled(pair(kinds()['door']) or ('', ''), state) == verb


@pytest.mark.parametrize('state, verb', [
    (SimpleNamespace(on=True), 'Off'), (SimpleNamespace(on=False), 'On'),
    (SimpleNamespace(names=['on', 'speed'], values=[1.0, 40.0]), 'Off'),
    (SimpleNamespace(names=['on'], values=[0.0]), 'On')])
def test_a_click_on_a_lamp_or_fan_switches_it(state: object, verb: str) -> None:
    for kind in ('lamp', 'appliance'):
        assert toggled(pair(kinds()[kind]) or ('', ''), state) == verb


def test_kinds_without_opposite_verbs_have_a_menu_only() -> None:
    assert pair(kinds()['elevator']) is None
