"""The PIRs of the building: their reports at rest, and after a person has left."""
import math
from pathlib import Path

import angen

BUILDING = Path(__file__).resolve().parents[2] / 'worlds/angen.world'
NODDING = 'livingroom_pir0_a'
NOD = 4.0     # s
SAMPLE = 0.1  # s


def pir_events(world: angen.World) -> list[tuple[float, str, str]]:
    return [(time, name, event) for time, name, kind, event, _ in world.events() if kind == 'pir']


def test_noise_alone_moves_none_of_them_from_the_start_on():
    w = angen.World(str(BUILDING))
    w.command('person', 'person', 'Stop')
    w.run(300)
    assert pir_events(w) == []


def test_the_nodding_one_reports_a_departure_and_no_motion_once_a_person_has_left():
    w = angen.World(str(BUILDING))
    w.run(2.5)  # he walks by
    assert any(name == NODDING and event == 'motion' for _, name, event in pir_events(w))
    w.delete('person')
    left = w.time
    departures = []
    while w.time < left + 3 * NOD:
        w.run(SAMPLE)
        reading = w.sensor('pir', NODDING)
        if reading['departure']:
            departures.append(w.time)
        assert not reading['motion'] or w.time <= left + SAMPLE
    assert all(time <= left + SAMPLE for time, _, event in pir_events(w) if event == 'motion')
    assert departures and departures[-1] <= left + NOD + SAMPLE


def test_the_nodding_one_reports_no_motion_of_a_person_who_has_stopped():
    w = angen.World(str(BUILDING))
    for _ in range(6):
        w.command('person', 'person', 'Go')
        w.run(1.7)
        w.command('person', 'person', 'Stop')
        w.run(1)  # until he has stopped
        pir_events(w)
        w.run(2 * NOD)
        assert [event for event in pir_events(w) if event[2] == 'motion'] == []


def test_the_nodding_one_reports_motion_only_while_somebody_is_in_its_field():
    # It compared with the scan of a nod ago: 23 of 84 events in 15 minutes came after he had left.
    w = angen.World(str(BUILDING))
    body = w.links.index('person::body')
    inside = outside = 0
    while w.time < 180:
        w.run(SAMPLE)
        x, y = w.link_poses[body][:2] - [4.15, 0.15]  # from the PIR, which looks along y = x
        seen = math.hypot(x, y) < 6.3 and abs(math.degrees(math.atan2(y, x)) - 45) < 60
        events = [each for each in pir_events(w) if each[1:] == (NODDING, 'motion')]
        inside += seen and len(events)
        outside += not seen and len(events)
    assert inside > 30 and outside == 0
