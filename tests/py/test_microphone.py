"""The microphone against the closed forms of one room, of two rooms, and of free air."""
from math import log10, pi, sin

import pytest

import angen
from sdf_text import DOORS, air, device, holder, include, sensor, walker

ROOMS = ('0 0.05 0 4 3 2.5', '0 -3 0 4 -0.05 2.5')      # their door in the wall between them
SURFACE = 2 * (4 * 2.95 + 2.95 * 2.5 + 4 * 2.5)
ABSORPTION = 0.2
CONSTANT = SURFACE * ABSORPTION / (1 - ABSORPTION)


def source(pose: str, level: float = 80, name: str = 'radio', directivity: float = 1) -> str:
    return device(name, 'libappliance.so', f'<on>true</on><directivity>{directivity}</directivity>'
                  f'<sound_power_level>{level}</sound_power_level>', pose)


def microphone(pose: str, extra: str = '<background>-40</background>', name: str = 'm') -> str:
    return holder(name, sensor('libmicrophone.so', extra, 2), pose)


def level(world: angen.World, name: str = 'm') -> float:
    world.run(0.6)
    return world.sensor('microphone', name)['level']


def direct(distance: float, directivity: float = 1) -> float:
    return directivity / (4 * pi * distance ** 2)


@pytest.mark.parametrize('distance, directivity', [(0.3, 1), (1, 1), (2, 4)])
def test_a_room_adds_its_diffuse_field(world, distance, directivity):
    w = world(air(ROOMS[0]) + source('1 1.5 1 0 0 0', directivity=directivity)
              + microphone(f'{1 + distance} 1.5 1 0 0 0'))
    expected = 80 + 10 * log10(direct(distance, directivity) + 4 / CONSTANT)
    assert level(w) == pytest.approx(expected, abs=0.001)


def between(area: float) -> float:
    """Gain into the second of two equal rooms that are joined by `area` of opening, m^2."""
    absorbing = SURFACE * ABSORPTION
    own, mixed = absorbing + area, area
    return 4 * (1 - ABSORPTION) * mixed / (own ** 2 - mixed ** 2)


def test_a_door_lets_through_the_share_of_its_open_width(world):
    w = world(air(*ROOMS) + source('1 1.5 1 0 0 0') + microphone('1 -1.5 1 0 0 0')
              + include('kitchen_door', 'hall_door0', '1.5 0 0 0 0 0'), DOORS)
    w.run(0.5)
    width, height = w.device('door', 'hall0')['width'], w.device('door', 'hall0')['height']
    heard = []
    for angle in (0.0, 0.05, 0.5, 1.57):
        w.command('door', 'hall0', f'Set {-angle}')
        w.run(6)
        turned = -w.device('door', 'hall0')['position']
        gap = min(width, 2 * width * sin(turned / 2)) if turned >= 0.01 else 0
        joined = height * (gap + (width - gap) * 10 ** -2.2) \
            + (4 * 2.5 - width * height) * 10 ** -3.8
        heard.append(level(w))
        assert heard[-1] == pytest.approx(80 + 10 * log10(between(joined)), abs=0.01), angle
    assert heard == sorted(heard) and heard[-1] - heard[0] > 15


def test_levels_add_as_powers_and_to_the_background(world):
    w = world(source('3 0 1 0 0 0', 70, 'a') + source('-3 0 1 0 0 0', 70, 'b')
              + microphone('0 0 1 0 0 0') + microphone('0 0 1 0 0 0', '', 'n'))
    one = 70 + 10 * log10(direct(3))
    assert level(w) == pytest.approx(one + 10 * log10(2), abs=0.001)
    w.command('appliance', 'a', 'Off')
    assert level(w) == pytest.approx(one, abs=0.001)
    w.command('appliance', 'b', 'Off')
    assert level(w) == pytest.approx(-40)
    assert level(w, 'n') == pytest.approx(30)


def test_an_open_window_lets_sound_out_and_none_in(world):
    """The room's own level falls by the opening's share of its absorption."""
    window = include('window', 'hall_window0', '1.5 0 1 0 0 0')
    w = world(air(ROOMS[0]) + source('1 1.5 1 0 0 0') + source('1 -4 1 0 0 0', 120, 'street')
              + microphone('3.5 2.5 1 0 0 0') + window, DOORS)
    near = direct((2.5 ** 2 + 1) ** 0.5)
    w.command('window', 'hall0', 'Open')
    w.run(5)
    gap = w.device('window', 'hall0')
    joined = gap['height'] * (gap['gap'] + (gap['width'] - gap['gap']) * 10 ** -2.2)
    expected = near + 4 * (1 - ABSORPTION) / (SURFACE * ABSORPTION + joined)
    assert level(w) == pytest.approx(80 + 10 * log10(expected), abs=0.001)


def test_it_gets_loud_above_its_threshold_and_quiet_three_decibels_below(world):
    w = world(include('stereo', 's') + microphone('2 0 0.1 0 0 0', '<threshold>63</threshold>'))
    w.command('appliance', 's', 'On')
    events = []
    for volume in (5, 40, 10, 5):
        w.command('appliance', 's', f'Volume {volume}')
        w.run(1.1)
        events.append((w.sensor('microphone', 'm')['loud'], round(level(w), 1)))
    loud = [state for state, _ in events]
    assert loud == [False, True, True, False], events


def test_its_noise_is_of_the_level(world):
    w = world(microphone('0 0 1 0 0 0', '<noise_stddev>1</noise_stddev>'))
    heard = [level(w) for _ in range(400)]
    mean = sum(heard) / len(heard)
    spread = (sum((x - mean) ** 2 for x in heard) / len(heard)) ** 0.5
    assert mean == pytest.approx(30, abs=0.2) and spread == pytest.approx(1, abs=0.15)


def test_a_source_on_another_storey_is_not_in_this_flat(world):
    upper = air('0 0.05 4 4 3 6.5').replace('"flat"', '"upper"')
    w = world(air(ROOMS[0]) + upper + source('1 1.5 5 0 0 0', 100) + microphone('1 1.5 1 0 0 0'))
    assert level(w) == pytest.approx(-40)


def test_a_person_is_heard_walking_and_speaking(world):
    """Steps of 55 dB and speech of 68.4 dB, from the mouth at 1.5 m."""
    w = world(walker('anna', '0 0 0', '20 0 8') + microphone('3 0 1.5 0 0 0'))

    def expected(source: float) -> float:
        x, y = (w.device('person', 'anna')[axis] for axis in 'xy')
        return source + 10 * log10(direct(((3 - x) ** 2 + y ** 2) ** 0.5))

    w.run(5)
    assert w.device('person', 'anna')['mode'] == 'WALKING'
    assert level(w) == pytest.approx(expected(55), abs=0.5)
    w.command('person', 'anna', 'Speak')
    assert level(w) == pytest.approx(expected(10 * log10(10 ** 5.5 + 10 ** 6.84)), abs=0.5)
    w.command('person', 'anna', 'Stop')
    w.run(2)
    assert level(w) == pytest.approx(expected(68.4), abs=0.01)
    w.command('person', 'anna', 'Quiet')
    assert level(w) == pytest.approx(-40)
    words = [event for _, source, _, event, _ in w.events() if source == 'anna']
    assert [word for word in words if word in ('speaks', 'quiet')] == ['speaks', 'quiet']
