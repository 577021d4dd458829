"""Radio: signal strength in free space, behind walls, doors, floors and bodies."""
from math import ceil, log10

import pytest

import angen
from sdf_text import DOORS, box, device, holder, include, sensor


def beacon(pose: str, name: str = 'b', extra: str = '') -> str:
    return device(name, 'libradio_transmitter.so', extra, pose)


def receiver(pose: str, extra: str = '') -> str:
    return holder('r', sensor('libradio_receiver.so', extra, 2), pose)


def heard(world: angen.World) -> dict[str, float]:
    world.run(0.6)
    reading = world.sensor('receiver', 'r')
    return dict(zip(reading['ids'], reading['rssi']))


def free(distance: float, frequency: float = 2440.0) -> float:
    """dBm of 0 dBm in free space: 32.45 + 20 lg(km) + 20 lg(MHz) is lost."""
    return -(32.4478 - 60 + 20 * log10(distance) + 20 * log10(frequency))


def test_power_gain_and_frequency_count(world):
    w = world(beacon('0 0 1 0 0 0', 'low', '<frequency>868</frequency><tx_power>14</tx_power>')
              + receiver('5 0 1 0 0 0', '<gain>3</gain>'))
    assert heard(w)['low'] == pytest.approx(free(5, 868) + 17, abs=0.01)


@pytest.mark.parametrize('size, loss', [
    ('0.005 3 4', 0), ('0.04 3 4', 3.4), ('0.1 3 4', 3.4), ('0.24 3 4', 6.9), ('0.6 3 4', 3.4)])
def test_a_wall_weakens_by_its_thickness(world, size, loss):
    w = world(beacon('0 0 1 0 0 0') + receiver('5 0.4 1 0 0 0')
              + box('wall', '2 0 1 0 0 0', size, static=True))
    distance = (25 + 0.16) ** 0.5
    assert heard(w)['b'] == pytest.approx(free(distance) - loss, abs=0.01)


def test_two_floors_cost_less_than_twice_one(world):
    w = world(beacon('0 0 1 0 0 0') + receiver('0.5 0 3.2 0 0 0')
              + box('slab', '0 0 2 0 0 0', '4 4 0.2', static=True))
    distance = (0.25 + 2.2 ** 2) ** 0.5
    assert heard(w)['b'] == pytest.approx(free(distance) - 18.3, abs=0.01)
    w.spawn(box('upper', '0 0 0 0 0 0', '4 4 0.2', static=True), 'upper', [0, 0, 2.6, 0, 0, 0])
    two = 18.3 * 2 ** (4 / 3 - 0.46)
    assert heard(w)['b'] == pytest.approx(free(distance) - two, abs=0.01)
    w.delete('upper')
    assert heard(w)['b'] == pytest.approx(free(distance) - 18.3, abs=0.01)


def test_a_door_that_opens_lets_the_signal_through(world):
    w = world(beacon('0.5 1 1 0 0 0') + receiver('0.5 -1.5 1 0 0 0')
              + include('kitchen_door', 'hall_door0'), DOORS)
    assert heard(w)['b'] == pytest.approx(free(2.5) - 3.4, abs=0.01)
    w.command('door', 'hall0', 'Open')
    w.run(5)
    assert heard(w)['b'] == pytest.approx(free(2.5), abs=0.01)


def test_a_person_who_comes_between_weakens_it(world):
    w = world(beacon('0 0 1 0 0 0') + receiver('4 0 1 0 0 0')
              + '''<actor name="anna"><script><trajectory id="0" type="walk">
      <waypoint><time>0</time><pose>2 1.5 0 0 0 -1.57</pose></waypoint>
      <waypoint><time>3</time><pose>2 0 0 0 0 -1.57</pose></waypoint>
      <waypoint><time>60</time><pose>2 0 0 0 0 -1.57</pose></waypoint></trajectory></script>
      </actor>''')
    assert heard(w)['b'] == pytest.approx(free(4), abs=0.01)
    w.run(8)
    assert heard(w)['b'] < free(4) - 3


def test_a_weak_or_silent_transmitter_is_not_received(world):
    w = world(beacon('0 0 1 0 0 0', 'near') + beacon('0 9 1 0 0 0', 'far')
              + receiver('2 0 1 0 0 0', '<sensitivity>-55</sensitivity>'))
    assert set(heard(w)) == {'near'}
    w.command('transmitter', 'near_transmitter', 'Off')
    assert heard(w) == {}
    w.run(10.0)
    w.command('transmitter', 'near_transmitter', 'On')
    assert set(heard(w)) == {'near'}
    words = [(event, detail) for _, source, _, event, detail in w.events() if source == 'r']
    assert words == [('received', 'near'), ('lost', 'near'), ('received', 'near')]


def test_noise_is_of_each_strength(world):
    w = world(beacon('0 0 1 0 0 0', 'a') + beacon('0 2 1 0 0 0', 'b')
              + receiver('3 0 1 0 0 0', '<noise_stddev>2</noise_stddev>'))
    rows = [heard(w) for _ in range(400)]
    for name, distance in (('a', 3), ('b', 13 ** 0.5)):
        errors = [row[name] - free(distance) for row in rows]
        assert sum(errors) / 400 == pytest.approx(0, abs=0.35)
        assert (sum(e * e for e in errors) / 400) ** 0.5 == pytest.approx(2, abs=0.3)


def test_a_robot_carries_a_transmitter(world):
    robot = include('turtlebot', 'robot', '1 0 0.001 0 0 0',
                    '<plugin name="t" filename="libradio_transmitter.so"><id>robot-7</id>'
                    '<position>0 0 0.6</position></plugin>')
    w = world(robot + receiver('4 0 0.6 0 0 0'))
    assert heard(w)['robot-7'] == pytest.approx(free(3), abs=0.1)


def test_a_signal_at_the_edge_is_not_received_and_lost_again_and_again(world):
    """A wall of 3.4 dB swings in and out; without it the signal is 1 dB above the sensitivity."""
    edge = free(4) - 1.0
    counts = {}
    for hysteresis in (0.0, 6.0):
        w = world(beacon('0 0 1 0 0 0') + receiver(
            '4 0 1 0 0 0', f'<sensitivity>{edge}</sensitivity>'
            f'<hysteresis>{hysteresis}</hysteresis><lost_after>0</lost_after>'))
        w.run(1.0)
        for i in range(5):
            w.spawn(box('wall', '0 0 0 0 0 0', '0.1 1 1', static=True), 'wall', [2, 0, 1, 0, 0, 0])
            w.run(1.0)
            w.delete('wall')
            w.run(1.0)
        counts[hysteresis] = sum(e[3] in ('received', 'lost') for e in w.events())
    assert counts == {0.0: 11, 6.0: 1}


def test_a_signal_below_the_hysteresis_is_lost(world):
    w = world(beacon('0 0 1 0 0 0') + receiver('4 0 1 0 0 0', f'<sensitivity>{free(4) - 0.5}'
                                               '</sensitivity><hysteresis>2</hysteresis>'))
    assert heard(w)
    w.spawn(box('wall', '0 0 0 0 0 0', '0.1 1 1', static=True), 'wall', [2, 0, 1, 0, 0, 0])
    assert not heard(w), '2.9 dB below the sensitivity'


def changes(w: angen.World) -> list[tuple[float, str, str]]:
    return [(time, event, detail) for time, _, _, event, detail in w.events()
            if event in ('received', 'lost')]


@pytest.mark.parametrize('silence, lost', [(2.0, False), (4.9, False), (5.4, True), (9.0, True)])
def test_a_transmitter_is_lost_after_a_time_without_reception(world, silence, lost):
    """Sampled at 2 Hz: the first sample without it is at 1.5 s."""
    w = world(beacon('0 0 1 0 0 0') + receiver('2 0 1 0 0 0', '<lost_after>5</lost_after>'))
    w.run(1.25)  # steady for two samples
    w.command('transmitter', 'b_transmitter', 'Off')
    w.run(0.5)
    assert w.sensor('receiver', 'r')['ids'] == [], 'the reading has the present transmitters'
    w.run(silence - 0.5)
    w.command('transmitter', 'b_transmitter', 'On')
    w.run(2.0)
    assert [(round(at, 2), event) for at, event, _ in changes(w)] == [(0.0, 'received')] + (
        [(6.5, 'lost'), (ceil(2 * (1.25 + silence)) / 2, 'received')] if lost else [])


def test_each_transmitter_has_its_events_when_one_is_lost_as_another_comes(world):
    w = world(beacon('0 0 1 0 0 0', 'a') + beacon('0 1 1 0 0 0', 'b') + receiver(
        '2 0 1 0 0 0', '<lost_after>0</lost_after>'))
    w.command('transmitter', 'b_transmitter', 'Off')
    w.run(2.0)
    w.command('transmitter', 'a_transmitter', 'Off')
    w.command('transmitter', 'b_transmitter', 'On')
    w.run(2.0)
    assert [what for _, *what in changes(w)[-2:]] == [['received', 'b'], ['lost', 'a']]


def test_a_person_who_walks_through_the_building_is_seldom_lost(building):
    """Counted again from the readings, which list the transmitters of each second."""
    w = angen.World(building, seed=3)
    reported: set[tuple[str, str]] = set()
    silent: dict[tuple[str, str], int] = {}
    expected = set()
    for second in range(180):
        w.run(0.5 if second == 0 else 1.0)
        heard_now = {(name, id_) for name in w.sensors('receiver')
                     for id_ in w.sensor('receiver', name)['ids']}
        for pair in heard_now:
            silent.pop(pair, None)
        for pair in reported - heard_now:
            silent.setdefault(pair, second)
        lost = {pair for pair, since in silent.items() if second - since >= 10}
        for pair in lost:
            del silent[pair]
        expected |= {(second, name, 'received') for name, _ in heard_now - reported}
        expected |= {(second, name, 'lost') for name, _ in lost}
        reported = (reported | heard_now) - lost
    counted = {(round(time), source, event) for time, source, _, event, _ in w.events()
               if source in w.sensors('receiver') and event in ('received', 'lost')}
    assert counted == expected
    assert len([e for e in counted if e[0] > 0]) <= 3 * 5, 'five a minute, ten receivers'
