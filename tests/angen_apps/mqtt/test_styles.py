"""Topics and payloads of Zigbee2MQTT."""
import json

import pytest

from tests.angen_apps.mqtt.fakes import Rig


@pytest.fixture
def rig() -> Rig:
    made = Rig('lamp/kitchen0', 'pir/kitchen_pir0', 'reed/kitchen_window0', 'door/hall',
               'doorbell/doorbell', style='zigbee2mqtt', prefix='zigbee2mqtt')
    made.world.has_state('lamp', 'kitchen0', on=True, level=50.0)
    made.world.has_state('door', 'hall', mode='CLOSED', position=0.0)
    made.world.has_summary('pir', 'kitchen_pir0', motion=1.0)
    made.world.has_summary('reed', 'kitchen_window0', closed=1.0)
    return made.turns()


def test_states_are_json(rig: Rig) -> None:
    base = 'zigbee2mqtt'
    assert rig.broker.json(f'{base}/Kitchen lamp') == {'state': 'ON', 'brightness': 127}
    assert rig.broker.json(f'{base}/Kitchen motion sensor') == {'occupancy': True}
    assert rig.broker.json(f'{base}/Kitchen window contact') == {'contact': True}
    assert rig.broker.json(f'{base}/Hall door')['state'] == 'CLOSE'
    assert rig.broker.json(f'{base}/Hall door/availability') == {'state': 'online'}
    assert rig.broker.json(f'{base}/bridge/state') == {'state': 'online'}


@pytest.mark.parametrize('topic, payload, commands', [
    ('set', '{"state": "OFF"}', ['Off']), ('set', '{"brightness": 127}', ['Dim 50']),
    ('set', '{"state": "ON", "brightness": 254}', ['Dim 100']), ('set', 'ON', ['On']),
    ('set/state', 'OFF', ['Off']), ('set/brightness', '0', ['Dim 0'])])
def test_commands(rig: Rig, topic: str, payload: str, commands: list[str]) -> None:
    rig.broker.receives(f'zigbee2mqtt/Kitchen lamp/{topic}', payload)
    rig.turns()
    assert [each.removeprefix('lamp/kitchen0 ').replace('49.99999999999999', '50')
            for each in rig.world.commands] == commands


@pytest.mark.parametrize('name, payload, problem', [
    ('Kitchen lamp', '{"state": ', 'is not JSON'), ('Kitchen lamp', '{"x": 1}', 'these do'),
    ('Kitchen lamp', '{"brightness": "high"}', "'high' is not a number"),
    ('Atlantis', '{"state": "ON"}', "there is no 'Atlantis'")])
def test_errors(rig: Rig, name: str, payload: str, problem: str) -> None:
    rig.broker.receives(f'zigbee2mqtt/{name}/set', payload)
    errors = [json.loads(text) for topic, text in rig.after() if topic.endswith('/error')]
    assert len(errors) == 1 and problem in errors[0]['error']


def test_a_state_that_is_asked_for_is_sent_again(rig: Rig) -> None:
    rig.broker.receives('zigbee2mqtt/Kitchen lamp/get', '{"state": ""}')
    assert rig.after() == [('zigbee2mqtt/Kitchen lamp', '{"state": "ON", "brightness": 127}')]


def test_bridge_devices_has_exposes(rig: Rig) -> None:
    devices = {each['friendly_name']: each
               for each in rig.broker.json('zigbee2mqtt/bridge/devices')}
    exposed = devices['Kitchen lamp']['definition']['exposes']
    assert exposed == [{'type': 'light', 'features': [
        {'type': 'binary', 'name': 'state', 'property': 'state', 'access': 3, 'value_on': 'ON',
         'value_off': 'OFF'},
        {'type': 'numeric', 'name': 'brightness', 'property': 'brightness', 'access': 3,
         'value_min': 0.0, 'value_max': 254.0}]}]
    motion, = devices['Kitchen motion sensor']['definition']['exposes']
    assert (motion['property'], motion['access']) == ('occupancy', 1)


def test_home_assistant_reads_values_by_templates(rig: Rig) -> None:
    contact = rig.broker.json(
        'homeassistant/binary_sensor/zigbee2mqtt/reed_kitchen_window0_open/config')
    assert contact['value_template'] == '{{ value_json.contact }}'
    assert (contact['payload_on'], contact['payload_off']) == ('False', 'True')
    light = rig.broker.json('homeassistant/light/zigbee2mqtt/lamp_kitchen0_state/config')
    assert light['brightness_scale'] == 254
    assert light['brightness_command_topic'] == 'zigbee2mqtt/Kitchen lamp/set/brightness'


def test_an_event_has_a_topic_of_its_own(rig: Rig) -> None:
    rig.world.has_state('doorbell', 'doorbell', rings=0)
    rig.turns()
    rig.world.has_state('doorbell', 'doorbell', rings=1)
    assert rig.after() == [('zigbee2mqtt/Doorbell/ring', '{"event_type": "ring"}')]
    assert rig.broker.json('homeassistant/event/zigbee2mqtt/doorbell_doorbell_ring/config')[
        'state_topic'] == 'zigbee2mqtt/Doorbell/ring'
