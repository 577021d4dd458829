"""Discovery of every component, against Home Assistant's keys."""
import copy
import json
from typing import Any

import pytest
from angen_tools.common.catalog import kinds

from tests.angen_apps.mqtt.fakes import Rig
from tests.angen_apps.mqtt.schema import errors, schema

# A thing of each kind that a home has.
KEYS = ['lamp/kitchen0', 'door/kitchen0', 'window/kitchen0', 'cabinet/kitchen0', 'pir/kitchen_pir0',
        'elevator/elevator', 'climate/apartment0', 'stove/kitchen0', 'appliance/kitchen_fan0',
        'appliance/kitchen_tv0', 'plug/kitchen_plug0', 'heater/heater', 'doorbell/doorbell',
        'daylight/sky', 'drive/turtlebot', 'battery/turtlebot_battery', 'person/anna',
        *(f'{kind}/{kind}0' for kind in ('pressure', 'contact', 'reed', 'switch', 'luminosity',
                                         'temperature', 'humidity', 'barometer', 'microphone',
                                         'proximity', 'receiver', 'rfid', 'load_cells',
                                         'soil_moisture', 'accelerometer'))]


def configs(rig: Rig) -> dict[str, Any]:
    return {topic: json.loads(payload) for topic, payload in rig.broker.retained.items()
            if topic.startswith('homeassistant/')}


@pytest.mark.parametrize('by_device', [False, True])
@pytest.mark.parametrize('style', ['plain', 'zigbee2mqtt'])
def test_each_component_has_only_keys_that_home_assistant_knows(style: str, by_device: bool
                                                                ) -> None:
    found = configs(Rig(*KEYS, style=style, by_device=by_device, truth=True).turns())
    assert [each for topic, config in found.items() for each in errors(topic, config)] == []
    if by_device:
        assert len(found) == len(KEYS) + 1
    else:
        assert {topic.split('/')[1] for topic in found} == set(schema()['components'])
    identities = [entity['unique_id'] for config in found.values()
                  for entity in config.get('components', {'': config}).values()]
    assert len(identities) == len(set(identities))


@pytest.mark.parametrize('key, value', [
    ('colour', 'red'), ('state_topic', 7), ('device_class', 'sunshine'), ('name', 3),
    ('availability', [{'topic': 'a/#'}]), ('device', {'name': 'x'}), ('unique_id', None)])
def test_the_schema_finds_nonsense(key: str, value: object) -> None:
    topic, config = next(iter(configs(Rig('pir/p').turns()).items()))
    assert errors(topic, config) == []
    wrong = {**copy.deepcopy(config), key: value}
    assert len(errors(topic, wrong)) == 1


def test_a_message_of_a_lamp() -> None:
    found = configs(Rig('lamp/kitchen0').turns())
    assert found['homeassistant/light/angen/lamp_kitchen0_state/config'] == {
        'name': None, 'unique_id': 'angen_lamp_kitchen0_state',
        'state_topic': 'angen/lamp/kitchen0/state',
        'command_topic': 'angen/lamp/kitchen0/state/set',
        'brightness_state_topic': 'angen/lamp/kitchen0/brightness',
        'brightness_command_topic': 'angen/lamp/kitchen0/brightness/set',
        'brightness_scale': 100, 'on_command_type': 'brightness',
        'device': {'identifiers': ['angen_lamp_kitchen0'], 'name': 'Kitchen lamp',
                   'manufacturer': 'Angen', 'model': 'Lamp', 'sw_version': '1.0',
                   'suggested_area': 'Kitchen'},
        'origin': {'name': 'Angen', 'sw_version': '1.0'},
        'availability': [{'topic': 'angen/bridge/state'}]}


def test_an_unknown_kind_follows_the_rule(monkeypatch: pytest.MonkeyPatch) -> None:
    fields = [{'name': 'on', 'type': 'flag', 'unit': '', 'words': [], 'shown': True},
              {'name': 'flow', 'type': 'number', 'unit': '%', 'words': [], 'shown': True},
              {'name': 'mode', 'type': 'choice', 'unit': '', 'words': ['WET', 'DRY'],
               'shown': True},
              {'name': 'water', 'type': 'number', 'unit': '°C', 'words': [], 'shown': True},
              {'name': 'clogged', 'type': 'flag', 'unit': '', 'words': [], 'shown': False,
               'alarm': True},
              {'name': 'inner', 'type': 'number', 'unit': 'm', 'words': [], 'shown': False}]
    verbs = [*({'name': name, 'argument': '', 'unit': '', 'count': 0}
               for name in ('On', 'Off', 'Flush')),
             {'name': 'SetFlow', 'argument': 'percent', 'unit': '%', 'min': 0, 'max': 80,
              'count': 1}]
    sprinkler = {'kind': 'sprinkler', 'role': 'device', 'verbs': verbs, 'values': [],
                 'fields': [{'alarm': False, 'decimals': 0, **each} for each in fields]}
    known = {**kinds(), 'sprinkler': sprinkler}
    monkeypatch.setattr('angen_apps.mqtt.things.kinds', lambda *_: known)
    monkeypatch.setattr('angen_apps.mqtt.bridge.kinds', lambda *_: known)
    rig = Rig('sprinkler/lawn').turns()
    found = {topic: config for topic, config in configs(rig).items() if 'sprinkler' in topic}
    assert [each for topic, config in found.items() for each in errors(topic, config)] == []
    assert {topic.split('/', 1)[1].removesuffix('/config') for topic in found} == {
        'switch/angen/sprinkler_lawn_state', 'button/angen/sprinkler_lawn_flush',
        'number/angen/sprinkler_lawn_set_flow', 'sensor/angen/sprinkler_lawn_mode',
        'sensor/angen/sprinkler_lawn_water', 'binary_sensor/angen/sprinkler_lawn_clogged'}
    number = found['homeassistant/number/angen/sprinkler_lawn_set_flow/config']
    assert (number['min'], number['max']) == (0, 80)
    rig.broker.receives('angen/sprinkler/lawn/set_flow/set', '30')
    rig.broker.receives('angen/sprinkler/lawn/flush/set', 'PRESS')
    rig.turns()
    assert rig.world.commands == ['sprinkler/lawn SetFlow 30', 'sprinkler/lawn Flush']


def test_every_kind_has_components_or_is_hidden() -> None:
    """A new kind needs a line of components.yaml, or the rule is right for it."""
    from angen_apps.mqtt.table import components, table
    for name, kind in kinds().items():
        if name not in table()['hidden']:
            assert components(kind, 'fan x', [0, 1], {'heating': 20.0}), name
    assert set(table()['hidden']) & set(table()['kinds']) == set()
