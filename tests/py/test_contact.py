"""Contact sensors in a world: a sitter's weight, and a bouncing ball."""
import math

import numpy as np
import pytest

import angen
from sdf_text import WORLDS

G = 9.8  # m/s2, SDF's default
CHAIR = '<include><uri>model://chair</uri><name>chair1</name><pose>0 0 0.001 0 0 0</pose></include>'
SEAT = 0.471  # m, its top


@pytest.fixture(autouse=True)
def models(monkeypatch):
    monkeypatch.setenv('ANGEN_MODEL_PATH', str(WORLDS / 'models'))


def weight(world: angen.World) -> float:
    """The load of the seat by the chair's sensor, N."""
    forces = np.reshape(world.sensor('contact', 'chair1')['forces'], (-1, 3))
    return -float(forces[:, 2].sum())


def test_a_sitter_has_its_weight_also_asleep(world):
    w = world(CHAIR)
    w.run(1)
    w.spawn('model://sitter', 'ann', [0, 0, SEAT + 0.001, 0, 0, 0])
    body = w.links.index('ann::body')
    awake = []
    for _ in range(10):
        w.run(0.5)
        awake.append(w.awake_bodies)
        if len(awake) > 2:
            assert weight(w) == pytest.approx(75 * G, rel=0.02), awake
    place = w.link_poses[body]
    assert awake[-1] == 0, 'sitter and chair sleep'
    w.run(60)
    assert weight(w) == pytest.approx(75 * G, rel=0.02)
    assert np.array_equal(w.link_poses[body], place)
    w.delete('ann')
    w.run(1.1)
    assert weight(w) == 0.0


RESTITUTION = 0.6
FALL = 0.5  # m
SURFACE = f'''<surface><bounce><restitution_coefficient>{RESTITUTION}</restitution_coefficient>
  <threshold>0</threshold></bounce></surface>'''
BALL = f'''<model name="ball"><pose>0 0 {FALL + 0.15} 0 0 0</pose><link name="link"><inertial>
  <mass>1</mass><inertia><ixx>4e-3</ixx><iyy>4e-3</iyy><izz>4e-3</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry>{SURFACE}
  </collision></link></model>'''


# With a sensor that looks at every tick; its top is at 0.05 m.
PLATE = f'''<model name="plate"><static>true</static><link name="link"><collision name="c">
  <pose>0 0 0.025 0 0 0</pose><geometry><box><size>1 1 0.05</size></box></geometry>{SURFACE}
  </collision><sensor name="touch" type="contact"><update_rate>1000</update_rate>
  <contact><collision>c</collision></contact>
  <plugin name="bumper" filename="libgazebo_ros_bumper.so"><debounce>0.05</debounce>
  <sample_rate>1000</sample_rate></plugin></sensor></link></model>'''


def events_of(world: angen.World) -> list[tuple[float, str]]:
    """Time and name of each event of the plate's sensor."""
    return [(t, event) for t, source, _, event, _ in world.events() if source == 'plate']


def flights() -> list[float]:
    """The times of the ball in the air between touches, s; nothing bounces below 0.05 m/s."""
    speeds = [RESTITUTION ** k * math.sqrt(2 * G * FALL) for k in range(1, 20)]
    return [2 * speed / G for speed in speeds if RESTITUTION * speed > 0.05]


def test_a_debounced_one_tells_when_it_has_come_to_lie(world):
    w = world(BALL + PLATE)
    w.run(4)
    events = events_of(w)
    assert [event for _, event in events] == ['pressed']
    lies = math.sqrt(2 * FALL / G) + sum(flights())
    assert events[0][0] == pytest.approx(lies + 0.05, abs=0.05)
    w.delete('ball')
    w.run(0.2)
    assert [event for _, event in events_of(w)] == ['released']


ROBOT = '''<model name="bot"><pose>0 0 0.16 0 0 0</pose><link name="link"><inertial><mass>3</mass>
  <inertia><ixx>0.05</ixx><iyy>0.05</iyy><izz>0.05</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.3 0.3 0.3</size></box></geometry><surface><friction>
  <ode><mu>0.3</mu><mu2>0.3</mu2></ode></friction></surface></collision>
  <sensor name="bumper" type="contact"><update_rate>10</update_rate>
  <contact><collision>c</collision></contact>
  <plugin name="bumper" filename="libgazebo_ros_bumper.so"/></sensor></link></model>'''
# A person pushes at a height of 0.25 m: with more friction than 0.15 / 0.25 the robot tips over.
PUSHER = '<actor name="ann"><pose>-1 0 0 0 0 0</pose></actor>'


def test_the_bumper_of_a_robot_that_is_pushed_names_the_person_all_the_way(world):
    w = world(ROBOT + PUSHER)
    place = w.links.index('bot::link')
    w.run(0.1)
    w.command('person', 'ann', 'PushTo 1.5 0')
    named = []
    while w.time < 4:
        x = w.link_poses[place][0]
        w.run(0.1)
        if w.link_poses[place][0] > x + 0.02:  # it was on the way
            found = w.sensor('contact', 'bot')['collision2']
            named.append(any(name.startswith('ann::') for name in found))
    assert len(named) >= 14
    assert sum(named) >= len(named) - 1, named
