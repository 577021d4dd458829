"""The bridge between a world and a broker, in this process."""
import json

import pytest
from angen_tools.common.failure import Failure

from tests.angen_apps.mqtt.fakes import OUTSIDE, FakeBroker, Rig


def lamp(rig: Rig) -> tuple[str | None, str | None]:
    return (rig.broker.retained.get('angen/lamp/kitchen0/state'),
            rig.broker.retained.get('angen/lamp/kitchen0/brightness'))


@pytest.fixture
def rig() -> Rig:
    made = Rig('lamp/kitchen0', 'pir/kitchen_pir0')
    made.world.has_state('lamp', 'kitchen0', on=True, level=40.0)
    return made.turns()


def test_states_are_retained_and_nothing_is_sent_without_a_change(rig: Rig) -> None:
    assert lamp(rig) == ('ON', '40')
    assert rig.after() == []
    rig.world.has_state('lamp', 'kitchen0', on=True, level=40.3)  # noise
    rig.world.has_summary('pir', 'kitchen_pir0', motion=0.0, difference=0.04)
    assert rig.after() == [('angen/pir/kitchen_pir0/motion', 'OFF')]
    rig.world.has_summary('pir', 'kitchen_pir0', motion=0.0, difference=0.05)
    assert rig.after() == []
    rig.world.has_state('lamp', 'kitchen0', on=False, level=0.0)
    assert rig.after() == [('angen/lamp/kitchen0/state', 'OFF'),
                           ('angen/lamp/kitchen0/brightness', '0')]


def test_each_event_is_sent_and_an_older_summary_does_not_undo_it(rig: Rig) -> None:
    for event in ('motion', 'still', 'motion'):
        rig.world.has_event('pir', 'kitchen_pir0', event, 5.0)
    rig.world.has_summary('pir', 'kitchen_pir0', 4.9, motion=0.0)
    topic = 'angen/pir/kitchen_pir0/motion'
    assert rig.after() == [(topic, 'ON'), (topic, 'OFF'), (topic, 'ON')]
    rig.world.has_summary('pir', 'kitchen_pir0', 6.0, motion=0.0)
    assert rig.after() == [(topic, 'OFF')]
    rig.world.has_event('pir', 'kitchen_pir0', 'reset', 0.0)
    rig.world.has_summary('pir', 'kitchen_pir0', 0.1, motion=1.0)
    assert rig.after() == [(topic, 'ON')]


@pytest.mark.parametrize('topic, payload, command', [
    ('state', 'ON', 'On'), ('state', 'off', 'Off'), ('state', 'true', 'On'),
    ('brightness', '40', 'Dim 40'), ('brightness', '12.5', 'Dim 12.5')])
def test_commands_are_executed(rig: Rig, topic: str, payload: str, command: str) -> None:
    rig.broker.receives(f'angen/lamp/kitchen0/{topic}/set', payload)
    rig.turns()
    assert rig.world.commands == [f'lamp/kitchen0 {command}']


@pytest.mark.parametrize('topic, payload, problem', [
    ('lamp/kitchen0/brightness', '101', "'101' is not a number of 0 to 100"),
    ('lamp/kitchen0/brightness', 'NaN', "'NaN' is not a number of 0 to 100"),
    ('lamp/kitchen0/brightness', '1e999', 'is not a number'),
    ('lamp/kitchen0/state', 'BLUE', "'BLUE' is none of ON, OFF"),
    ('lamp/kitchen0/state', b'\xff\xfe', 'not UTF-8'),
    ('lamp/kitchen0/color', 'red', "'color' takes no commands; these do: state, brightness"),
    ('pir/kitchen_pir0/motion', 'ON', "'motion' takes no commands; nothing of it does"),
    ('lamp/atlantis/state', 'ON', "there is no lamp 'atlantis'")])
def test_what_is_rejected_is_told(rig: Rig, topic: str, payload: str | bytes, problem: str) -> None:
    rig.broker.receives(f'angen/{topic}/set', payload)
    sent = dict(rig.after())
    error = next(json.loads(text) for name, text in sent.items() if name.endswith('/error'))
    assert problem in error['error'] and error['topic'] == f'angen/{topic}/set'
    assert rig.world.commands == []
    assert len(rig.log) == 1 and problem in rig.log[0]
    assert not any(name.endswith('/error') for name in rig.broker.retained)


def test_after_a_rejection_the_state_that_holds_is_sent_again(rig: Rig) -> None:
    rig.world.rejects = 'On'
    rig.broker.receives('angen/lamp/kitchen0/state/set', 'ON')
    assert [each for each in rig.after() if 'error' not in each[0]] == [
        ('angen/lamp/kitchen0/state', 'ON'), ('angen/lamp/kitchen0/brightness', '40')]


def test_a_retained_command_is_not_executed(rig: Rig) -> None:
    rig.broker.receives('angen/lamp/kitchen0/state/set', 'OFF', retained=True)
    rig.turns()
    assert rig.world.commands == []


def test_a_cover_has_positions_and_stops() -> None:
    rig = Rig('door/kitchen0')
    rig.world.has_state('door', 'kitchen0', mode='CLOSED', position=0.0)
    rig.world.has_summary('door', 'kitchen0', position=0.0, opens=-1.6)
    rig.turns()
    base = 'angen/door/kitchen0'
    assert rig.broker.retained[f'{base}/position'] == '0'
    rig.world.has_state('door', 'kitchen0', mode='OPENING', position=-0.8)
    rig.turns()
    assert rig.broker.retained[f'{base}/state'] == 'opening'
    assert rig.broker.retained[f'{base}/position'] == '50'
    rig.broker.receives(f'{base}/state/set', 'STOP')
    rig.broker.receives(f'{base}/position/set', '25')
    rig.world.rejects = 'Set -0.6'
    rig.broker.receives(f'{base}/position/set', '37.5')  # it opens to the other side
    rig.turns()
    assert rig.world.commands == [f'door/kitchen0 Set {angle}' for angle in (-0.8, -0.4, 0.6)]


def test_things_come_and_go(rig: Rig) -> None:
    rig.world.keys.append('lamp/spare')
    rig.world.has_state('lamp', 'spare', on=True, level=7.0)  # comes before the event is read
    rig.world.has_event('model', 'spare', 'spawned')
    rig.turns()
    assert rig.broker.retained['angen/lamp/spare/brightness'] == '7'
    config = 'homeassistant/light/angen/lamp_spare_state/config'
    assert rig.broker.json(config)['device']['name'] == 'Spare lamp'
    rig.world.has_state('lamp', 'spare', on=True, level=9.0)
    rig.turns()
    assert rig.broker.retained['angen/lamp/spare/state'] == 'ON'
    rig.world.keys.remove('lamp/spare')
    rig.world.has_event('model', 'spare', 'deleted')
    rig.turns()
    assert not [topic for topic in rig.broker.retained if 'spare' in topic]
    assert lamp(rig) == ('ON', '40')


@pytest.mark.parametrize('text', [
    'no JSON', '[' * 10_000, '7', '{"id": 1, "topics": [3]}', '{"topics": ["angen/x"]}',
    '{"id": "x", "topics": ["elsewhere/lamp", "angen/#", "homeassistant/+/a"]}'])
def test_a_false_list_of_topics_removes_nothing(text: str) -> None:
    rig = Rig('lamp/kitchen0')
    rig.broker.retained |= {'angen/bridge/topics': text, 'elsewhere/lamp': 'ON', 'angen/x': '1'}
    rig.turns()
    assert rig.broker.retained['elsewhere/lamp'] == 'ON'
    assert rig.broker.retained['angen/x'] == '1'
    assert not [topic for topic, payload in rig.broker.sent if set(topic) & set('+#')]


def test_a_broker_without_memory_gets_everything_again(rig: Rig) -> None:
    before = dict(rig.broker.retained)
    rig.broker.connected = False
    rig.world.has_state('lamp', 'kitchen0', on=True, level=70.0)
    assert rig.after() == []
    rig.broker.restarts()
    rig.broker.connected = True
    rig.turns()
    assert rig.broker.retained == {**before, 'angen/lamp/kitchen0/brightness': '70'}


def test_the_birth_of_home_assistant_has_all_sent_again(rig: Rig) -> None:
    rig.broker.receives('homeassistant/status', 'offline')
    assert rig.after() == []
    rig.broker.receives('homeassistant/status', 'online')
    topics = [topic for topic, _ in rig.after()]
    assert {'homeassistant/light/angen/lamp_kitchen0_state/config',
            'angen/lamp/kitchen0/state', 'angen/bridge/state'} <= set(topics)


def test_an_answer_that_is_read_late_ends_it_too(rig: Rig, monkeypatch: pytest.MonkeyPatch
                                                 ) -> None:
    monkeypatch.setattr('angen_apps.mqtt.bridge.ANSWER', 0.0)
    link = FakeBroker(rig.broker)
    second = rig.another(link)
    with pytest.raises(Failure, match='has the prefix angen on this broker'):
        second.turn()
        rig.bridge.turn()  # its answer waits at the newcomer, whose time is up
        second.turn()
        second.turn()


def test_after_a_crash_of_the_broker_nobody_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('angen_apps.mqtt.bridge.ANSWER', 0.0)
    rig = Rig('lamp/kitchen0')
    rig.broker.retained |= {'angen/bridge/state': 'online',
                            'angen/bridge/topics': '{"id": "x", "topics": []}'}
    rig.turns()
    assert 'homeassistant/light/angen/lamp_kitchen0_state/config' in rig.broker.retained


def test_a_doorbell_is_an_event_and_is_not_retained() -> None:
    rig = Rig('doorbell/doorbell')
    rig.world.has_state('doorbell', 'doorbell', rings=3)
    rig.turns()
    assert not [topic for topic, _ in rig.broker.sent if topic.endswith('/ring')]
    rig.world.has_state('doorbell', 'doorbell', rings=5)
    assert rig.after() == [('angen/doorbell/doorbell/ring', '{"event_type": "ring"}')] * 2
    rig.world.has_state('doorbell', 'doorbell', rings=0)  # a reset
    assert rig.after() == []
    assert 'angen/doorbell/doorbell/ring' not in rig.broker.retained


def test_rooms_are_of_robots_and_by_wish_of_people(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('angen_apps.mqtt.bridge.ROOM_PERIOD', 0.0)
    rig = Rig('drive/robot', 'person/anna').turns()
    assert rig.broker.retained['angen/drive/robot/room'] == 'Kitchen'
    assert not [topic for topic in rig.broker.retained if 'anna' in topic]
    rig.world.at = OUTSIDE
    assert rig.after() == [('angen/drive/robot/room', 'outside')]
    rig = Rig('person/anna', truth=True).turns()
    assert rig.broker.retained['angen/person/anna/room'] == 'Kitchen'
    assert rig.broker.json('homeassistant/sensor/angen/person_anna_room/config')['options'] == [
        'Kitchen', 'outside']


def test_the_simulation_is_a_thing(rig: Rig) -> None:
    base = 'angen/simulation/simulation'
    assert [rig.broker.retained[f'{base}/{key}'] for key in ('time', 'factor', 'rate', 'paused')
            ] == ['60', '1.0', '1.0', 'OFF']
    rig.broker.receives(f'{base}/rate/set', '5')
    rig.broker.receives(f'{base}/paused/set', 'ON')
    rig.turns()
    assert rig.world.rate == 5.0 and rig.world.commands == ['pause']
    assert rig.broker.retained[f'{base}/rate'] == '5.0'


def test_a_plug_counts_kilowatt_hours() -> None:
    rig = Rig('plug/tv')
    rig.world.has_summary('plug', 'tv', connected=1.0, power=100.0, energy=9e6)
    rig.turns()
    assert [rig.broker.retained[f'angen/plug/tv/{key}']
            for key in ('plugged', 'power', 'energy')] == ['ON', '100.0', '2.500']


def test_hostile_names_are_escaped_in_topics() -> None:
    rig = Rig('lamp/a/#+ ü\x7f').turns()
    ours = [topic for topic in rig.broker.retained if 'lamp' in topic]
    assert ours and not [topic for topic in ours if set(topic) & set('#+ ü\x7f')]
    rig.broker.receives(f'angen/lamp/{ours[0].split("lamp_")[1].split("_state")[0]}/state/set',
                        'ON')
    rig.turns()
    assert rig.world.commands == ['lamp/a/#+ ü\x7f On']


def test_a_robot_is_a_vacuum_that_cleans_while_it_drives() -> None:
    """Home Assistant takes the state of a vacuum as JSON."""
    rig = Rig('drive/robot').turns()
    states = []
    for time, speed in enumerate((0.0, -0.2, 0.001), 1):
        rig.world.has_summary('drive', 'robot', float(time), v=speed)
        rig.turns()
        states.append(rig.broker.json('angen/drive/robot/state'))
    assert states == [{'state': word} for word in ('idle', 'cleaning', 'idle')]
    rig.broker.receives('angen/drive/robot/state/set', 'stop')
    rig.turns()
    assert rig.world.commands == ['drive/robot Stop']


def test_floors_of_summaries_have_their_words() -> None:
    """Home Assistant rejects a state of a select that is none of its options."""
    rig = Rig('elevator/lift').turns()
    rig.world.has_summary('elevator', 'lift', 1.0, target_floor=1.0)
    rig.turns()
    options = rig.broker.json('homeassistant/select/angen/elevator_lift_floor/config')['options']
    assert rig.broker.retained['angen/elevator/lift/floor'] == options[1] == 'Floor 1'
