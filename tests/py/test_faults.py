"""Faults of sensors: as often as requested, and each of them is reported."""
from math import log

import pytest

import angen
from sdf_text import box, holder, include, sensor

TURNS = 600
Event = tuple[float, str]


def plug(fault: str = '') -> str:
    inside = f'<fault>{fault}</fault>' if fault else ''
    return holder('p', sensor('libsmart_plug.so', f'<load>appliance/fan</load>{inside}'))


def switched(w: angen.World, turns: int = TURNS) -> tuple[list[Event], list[Event]]:
    """A fan is switched on and off each second: reports of its plug, and effects of faults."""
    w.command('appliance', 'fan', 'Speed 50')
    w.events()
    for i in range(turns):
        w.command('appliance', 'fan', 'Off' if i % 2 else 'On')
        w.run(1.0)
    w.run(30.0)
    every = w.events()
    return ([(time, event) for time, source, kind, event, _ in every
             if (kind, source) == ('plug', 'p')],
            [(time, f'{event} {detail}') for time, source, kind, event, detail in every
             if (kind, source) == ('fault', 'p')])


def made(world, fault: str) -> angen.World:
    w = world(include('fan', 'fan') + plug(), seed=3)
    w.run(1.0)
    if fault:
        w.command('fault', 'plug/p', fault)
    return w


def test_dropouts_are_binomial_and_each_is_reported(world):
    right, none = switched(made(world, ''))
    assert len(right) == TURNS and not none
    got, reported = switched(made(world, 'dropout share=0.2'))
    lost = [line for _, line in reported if line != 'dropout plug: reading lost']
    assert len(got) + len(lost) == TURNS and set(got) < set(right)
    assert abs(len(lost) - 0.2 * TURNS) < 2.58 * (TURNS * 0.2 * 0.8) ** 0.5  # 99 %
    again, _ = switched(made(world, 'dropout share=0.2'))
    assert again == got


def test_delays_duplicates_and_a_fast_clock_move_events_by_as_much(world):
    right, _ = switched(made(world, ''), 100)
    got, reported = switched(made(world, 'delay by=5'), 100)
    assert got == [(pytest.approx(time + 5.0), event) for time, event in right] and reported
    got, _ = switched(made(world, 'duplicate share=1'), 100)
    assert len(got) == 200 and sorted(got)[::2] == right
    got, _ = switched(made(world, 'clock seconds_per_day=8640'), 100)
    assert got == [(pytest.approx(time + (time - 1.0) * 0.1), event) for time, event in right]


def test_a_stuck_sensor_and_an_empty_battery_send_no_news(world):
    right, _ = switched(made(world, ''), 100)
    w = made(world, 'stuck from=20 lasts=40')
    got, _ = switched(w, 100)
    assert got == [(time, event) for time, event in right if not 21 <= time < 61]
    w.command('appliance', 'fan', 'On')
    w.command('fault', 'p', 'stuck')
    w.run(1.0)
    held = w.sensor('plug', 'p')['power']
    w.command('appliance', 'fan', 'Speed 100')
    w.run(2.0)
    assert w.sensor('plug', 'p')['power'] == held != 50
    w.command('fault', 'p', 'Off')
    w.run(0.2)
    assert w.sensor('plug', 'p')['power'] == pytest.approx(50)
    got, _ = switched(made(world, 'battery from=10 lasts=60'), 100)
    fails = [time for time, _ in right if time not in dict(got)]
    assert min(fails) > 11 and not [time for time, _ in got if time > 71]
    assert len([t for t in fails if t < 41]) < len([t for t in fails if 41 <= t < 71])


def test_false_alarms_are_a_poisson_process_with_an_end_each(world):
    w = world('<include><uri>model://chair</uri><name>c</name></include>', seed=5)
    w.run(2.0)
    w.command('fault', 'contact/*', 'false_alarm per_day=2000')
    w.events()
    w.run(43200.0)
    every = w.events()
    alarms = [time for time, _, kind, event, _ in every if (kind, event) == ('contact', 'pressed')]
    ends = [time for time, _, kind, event, _ in every if (kind, event) == ('contact', 'released')]
    faults = [time for time, _, kind, event, _ in every
              if (kind, event) == ('fault', 'false_alarm')]
    assert faults == alarms and len(ends) in (len(alarms), len(alarms) - 1)
    assert abs(len(alarms) - 1000) < 100
    gaps = sorted(b - a for a, b in zip(alarms, alarms[1:]))
    assert gaps[len(gaps) // 2] == pytest.approx(43.2 * log(2), rel=0.2)
    assert all(1.2 < b - a < 6.1 for a, b in zip(alarms, ends))


def test_a_sensor_that_is_knocked_aside_measures_from_there(world):
    w = world(box('wall', '3 0 1 0 0 0', '0.2 4 2', static=True)
              + '<model name="s"><static>true</static><pose>0 0 1 0 0 0</pose><link name="l">'
              '<sensor name="s" type="ray"><ray><scan><horizontal><samples>1</samples>'
              '<min_angle>0</min_angle><max_angle>0</max_angle></horizontal></scan><range>'
              '<min>0.05</min><max>10</max></range></ray><plugin name="s" '
              'filename="libgazebo_ros_laser.so"><fault>moved from=5 x=0.5 z=0.1</fault></plugin>'
              '</sensor></link></model>')
    w.request('lidar', 's')
    w.run(4.0)
    assert w.sensor('lidar', 's')['ranges'][0] == pytest.approx(2.9, abs=1e-3)
    w.run(3.0)
    assert w.sensor('lidar', 's')['ranges'][0] == pytest.approx(2.4, abs=1e-3)
    assert [event for _, _, kind, event, _ in w.events() if kind == 'fault'] == ['moved']
    place = next(pose for _, name, _, pose in w.entities() if name == 's')
    assert place[0] == pytest.approx(0.5) and place[2] == pytest.approx(1.1)


def test_what_is_wrong_is_said_and_changes_nothing(world):
    w = made(world, '')
    for name, text, says in (('plug/p', 'dropouts share=0.1', 'did you mean dropout'),
                             ('plug/p', 'dropout', 'share= is missing'),
                             ('plug/p', 'dropout share=2', 'from 0 to 1'),
                             ('plug/p', 'delay by=3-1', 'ends first'),
                             ('plug/p', 'false_alarm per_day=3', 'raises no alarms'),
                             ('nobody', 'stuck', "no sensor is named 'nobody'")):
        with pytest.raises(angen.Error, match=says):
            w.command('fault', name, text)
    assert len(switched(w, 10)[0]) == 10
    with pytest.raises(angen.Error, match='share= is missing'):
        world(include('fan', 'fan') + plug(fault='dropout'))
