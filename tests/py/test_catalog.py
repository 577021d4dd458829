"""The small sensors of the catalog, each against what geometry or physics say it must read."""
from math import asin, exp

import pytest

import angen
from sdf_text import DOORS, air, box, holder, include, sensor


# proximity

ASIDE = box('aside', '1 0.4 1 0 0 0', '0.2 0.2 2', static=True)   # 17 degrees off at least
AHEAD = box('ahead', '2 0.1 1 0 0 0', '0.2 0.2 2', static=True)


def wall(x: float) -> str:
    return box('wall', f'{x + 0.5} 0 1 0 0 0', '1 4 4', static=True)


@pytest.mark.parametrize('things, distance, error', [
    (wall(0.1), 0.1, 0.01), (wall(1.0), 1.0, 0.01), (wall(3.5), 3.5, 0.01),
    (ASIDE + AHEAD, 1.9, 0.02), (wall(4.6), float('inf'), 0)])
def test_proximity_reads_the_nearest_in_its_cone(world, things, distance, error):
    w = world(include('proximity', 'p', '0 0 1 0 0 0') + things)
    for _ in range(20):
        w.run(0.1)
        assert w.sensor('proximity', 'p')['range'] == pytest.approx(distance, abs=error)


# pressure mat

def weighed(world, mass: float) -> angen.World:
    return world(include('pressure_mat', 'm', '0 0 0 0 0 0')
                 + box('crate', '0.1 0 0.155 0 0 0', '0.3 0.3 0.3', mass=mass))


@pytest.mark.parametrize('mass, fires', [(9.5, False), (10.5, True), (70.0, True)])
def test_the_mat_fires_above_its_threshold_only(world, mass, fires):
    w = weighed(world, mass)
    w.run(2)
    reading = w.sensor('pressure', 'm')
    assert reading['pressed'] == fires
    assert reading['load'] == pytest.approx(mass * 9.8 / 9.80665, rel=0.02)


def test_the_mat_knows_a_weight_that_sleeps_and_one_that_left(world):
    w = weighed(world, 20)
    w.run(5)
    assert w.sensor('pressure', 'm')['pressed']
    w.delete('crate')
    w.run(1.1)
    assert not w.sensor('pressure', 'm')['pressed'] and w.sensor('pressure', 'm')['load'] == 0


# reed contact, window and cabinet

def angle_at(distance: float, shut: float, radius: float) -> float:
    """rad that a magnet `radius` off its hinge has turned when it is `distance` from a reed that
    is `shut` above its place."""
    return 2 * asin((distance ** 2 - shut ** 2) ** 0.5 / (2 * radius))


def swing(world: angen.World, name: str, joint: str) -> list[tuple[float, bool]]:
    """(angle, closed) a hundred times a second while it turns to its target."""
    seen = []
    index = world.joints.index(joint)
    for _ in range(400):
        world.run(0.01)
        seen.append((-world.joint_positions[index], world.sensor('reed', name)['closed']))
    return seen


def test_a_reed_opens_and_closes_at_the_angles_that_geometry_gives(world):
    w = world(include('window', 'hall_window0', '0 0 1 0 0 0'), DOORS)
    radius = (0.93 ** 2 + 0.008 ** 2) ** 0.5
    w.run(0.5)
    assert w.sensor('reed', 'hall_window0')['closed']
    assert w.sensor('reed', 'hall_window0')['distance'] == pytest.approx(0.012, abs=1e-3)
    w.command('window', 'hall0', 'Open')
    opened = next(a for a, closed in swing(w, 'hall_window0', 'hall_window0::sash')
                  if not closed)
    assert opened == pytest.approx(angle_at(0.02, 0.012, radius), abs=0.01)
    w.command('window', 'hall0', 'Close')
    closed = next(a for a, shut in swing(w, 'hall_window0', 'hall_window0::sash') if shut)
    assert closed == pytest.approx(angle_at(0.015, 0.012, radius), abs=0.01)
    assert closed < opened


def test_a_window_takes_a_doors_commands(world):
    w = world(include('window', 'hall_window0', '0 0 1 0 0 0'), DOORS)
    w.command('window', 'hall0', 'Set -0.5')
    w.run(3)
    state = w.device('window', 'hall0')
    assert state['mode'] == 'AJAR' and state['position'] == pytest.approx(-0.5, abs=0.005)
    with pytest.raises(angen.Error, match='a window takes Open, Close, OpenByHand, CloseByHand, '
                       'Unlatch, Set <radians>'):
        w.command('window', 'hall0', 'Tilt')
    w.command('window', 'hall0', 'Close')
    w.run(3)
    assert w.device('window', 'hall0')['mode'] == 'CLOSED'


def test_a_cabinet_that_bounces_off_something_hard_is_blocked_until_it_is_gone(world):
    w = world(include('wall_cabinet', 'wall_cabinet0', '0 0 1.4 0 0 0')
              + box('post', '0.36 -0.74 1.7 0 0 0', '0.04 0.04 0.4', static=True))
    w.command('cabinet', 'wall0', 'Open')
    w.run(4)
    assert w.device('cabinet', 'wall0')['mode'] == 'BLOCKED'
    w.run(2)
    assert w.device('cabinet', 'wall0')['mode'] == 'BLOCKED'
    w.delete('post')
    w.run(4)
    assert w.device('cabinet', 'wall0')['mode'] == 'OPEN'


def test_a_reed_can_be_put_on_a_door(world):
    w = world(include('kitchen_door', 'kitchen_door0', '0 0 0 0 0 0'),
              DOORS)
    w.spawn(sensor('libreed_contact.so', '<magnet_link>door</magnet_link>'
                   '<magnet>0.93 -0.015 2.078</magnet>', 1), 'r',
            [0.93, -0.015, 2.09, 0, 0, 0], 'kitchen_door0::base')
    w.run(1.1)
    assert w.sensor('reed', 'r')['closed']
    w.command('door', 'kitchen0', 'Open')
    w.run(2)
    assert not w.sensor('reed', 'r')['closed']


def test_a_reed_names_the_links_it_could_have(world):
    with pytest.raises(angen.Error, match="no link 'leaf'; known are base, pane"):
        world(include('window', 'w', '0 0 1 0 0 0')).spawn(
            sensor('libreed_contact.so', '<magnet_link>leaf</magnet_link>'), 'r',
            [0, 0, 0, 0, 0, 0], 'w::base')


# RFID

TAG = '<plugin name="tag" filename="librfid_tag.so"><id>{}</id><position>{}</position></plugin>'


@pytest.mark.parametrize('pose, read', [
    ('1.9 0 1 0 0 0', True), ('2.1 0 1 0 0 0', False),          # range 2 m
    ('0.8 1.2 1 0 0 0', True), ('0.4 1.2 1 0 0 0', False),      # 60 degrees to a side
    ('-1 0 1 0 0 0', False)])
def test_a_tag_is_read_in_range_and_beam(world, pose, read):
    w = world(include('rfid_reader', 'r', '0 0 1 0 0 0') + include('rfid_tag', 'card', pose))
    w.run(0.2)
    assert w.sensor('rfid', 'r')['ids'] == (['card'] if read else [])


def test_a_tag_behind_a_wall_is_never_read(world):
    """The tag passes behind the wall and comes out at its end."""
    w = world(include('rfid_reader', 'r', '0 0 1 0 0 0')
              + box('wall', '1 -1 1 0 0 0', '0.1 2 2', static=True))
    for y in (-1.0, -0.5, -0.05, 0.05, 0.5):
        w.spawn('model://rfid_tag', 'card', [1.1, y, 1, 0, 0, 0])
        w.run(0.2)
        assert w.sensor('rfid', 'r')['ids'] == (['card'] if y > 0.01 else []), y
        w.delete('card')


def test_people_robots_and_things_carry_tags(world):
    person = '''<actor name="anna"><script><trajectory id="0" type="walk">
      <waypoint><time>0</time><pose>1 0.8 0 0 0 3.14159</pose></waypoint>
      <waypoint><time>30</time><pose>0.9 0.8 0 0 0 3.14159</pose></waypoint></trajectory></script>
      ''' + TAG.format('anna-badge', '0.26 0 1.2') + '</actor>'
    w = world(include('rfid_reader', 'r', '0 0 1 0 0 0') + person
              + include('turtlebot', 'robot', '1 0 0.001 0 0 3.14159',
                        TAG.format('robot-7', '0.19 0 0.2'))
              + include('chair', 'seat', '1 -0.8 0.001 0 0 3.14159',
                        TAG.format('chair-1', '0.22 0 0.45')))
    w.run(0.5)
    reading = w.sensor('rfid', 'r')
    assert reading['ids'] == ['anna-badge', 'chair-1', 'robot-7']
    assert reading['distances'][1] == pytest.approx((0.78 ** 2 + 0.8 ** 2 + 0.55 ** 2) ** 0.5,
                                                    abs=0.02)


def test_a_body_shades_the_tag_behind_it(world):
    w = world(include('rfid_reader', 'r', '0 0 1 0 0 0')
              + include('turtlebot', 'robot', '1 0 0.001 0 0 0', TAG.format('x', '0.19 0 0.1')))
    w.run(0.2)
    assert w.sensor('rfid', 'r')['ids'] == []


# smart plug

def test_a_plugs_energy_is_power_times_time(world):
    w = world(include('ceiling_lamp', 'hall_lamp0', '0 0 2.5 0 0 0')
              + holder('s', sensor('libsmart_plug.so', '<load>lamp/hall0</load>', 1)))
    w.run(0.5)
    assert w.sensor('plug', 's')['energy'] == 0
    expected = 0.0
    for level, seconds in ((100, 7.503), (40, 12.251), (0, 3.007), (75, 20.0)):
        w.command('lamp', 'hall0', f'Dim {level}')
        w.run(seconds)
        expected += 10.0 * level / 100 * seconds
    # It publishes at whole seconds; the last was 0.261 s ago.
    expected -= 7.5 * (w.time % 1)
    reading = w.sensor('plug', 's')
    assert reading['connected'] and reading['power'] == 7.5
    assert reading['energy'] == pytest.approx(expected, rel=1e-3)


def test_a_plug_without_its_load_says_so(world):
    w = world(holder('s', sensor('libsmart_plug.so', '<load>lamp/none0</load>')))
    w.run(0.1)
    assert w.sensor('plug', 's')['connected'] is False and w.sensor('plug', 's')['power'] == 0


# temperature and humidity

LEAKS = '<heat_loss>0.8</heat_loss><air_change>0.5</air_change><heat_capacity>1.2</heat_capacity>'


def test_a_heater_in_a_closed_room_follows_the_closed_form(world):
    """T = T0 + P / L (1 - exp(-t L / C)) in a room of 30 m^3 with 1 kW, started at outside's."""
    w = world(air('0 0 0 4 3 2.5', extra=LEAKS + '<temperature>10</temperature>'
                  '<outside_temperature>10</outside_temperature>')
              + include('heater', 'heater', '0.1 1.5 0 0 0 0')
              + include('temperature_sensor', 't', '2 1.5 1.5 0 0 0'))
    w.command('heater', 'heater', 'On')
    volume = 30.0
    loss = 0.8 * volume + 1.204 * 1006 * 0.5 / 3600 * volume
    capacity = 1.2 * 1.204 * 1006 * volume
    for _ in range(3):
        w.run(200)
        rise = 1000 / loss * (1 - exp(-w.time * loss / capacity))
        assert w.sensor('temperature', 't')['temperature'] - 10 == pytest.approx(rise, rel=0.02)
    assert rise > 10


def test_a_closed_room_keeps_its_vapor_and_dries_relatively(world):
    w = world(air('0 0 0 4 3 2.5', extra='<air_change>0</air_change>')
              + include('heater', 'heater', '0.1 1.5 0 0 0 0')
              + include('humidity_sensor', 'h', '2 1.5 1.5 0 0 0')
              + include('temperature_sensor', 't', '2 1.5 1.5 0 0 0'))
    w.run(1.1)
    assert w.sensor('humidity', 'h')['humidity'] == pytest.approx(50, abs=0.1)
    w.command('heater', 'heater', 'Set 50')
    w.run(300)
    # The same vapor pressure over the saturation pressure of warmer air.
    warm = w.sensor('temperature', 't')['temperature']
    drier = 50 * exp(17.62 * 20 / 263.12 - 17.62 * warm / (243.12 + warm))
    assert warm > 21 and w.sensor('humidity', 'h')['humidity'] == pytest.approx(drier, abs=0.3)


@pytest.mark.parametrize('opens', [False, True])
def test_an_open_door_lets_the_warm_air_through(world, opens):
    """Two rooms of 4 m x 3 m side by side, their door in the wall between them."""
    w = world(air('0 0.05 0 4 3 2.5', '0 -3 0 4 -0.05 2.5', extra='<heat_loss>0</heat_loss>'
                  '<air_change>0</air_change>')
              + include('heater', 'heater', '0.1 1.5 0 0 0 0')
              + include('kitchen_door', 'hall_door0', '1.5 0 0 0 0 0')
              + include('temperature_sensor', 'warm', '2 1.5 1.5 0 0 0')
              + include('temperature_sensor', 'cold', '2 -1.5 1.5 0 0 0'),
              DOORS)
    if opens:
        w.command('door', 'hall0', 'Open')
    w.command('heater', 'heater', 'On')
    w.run(200)
    warm, cold = (w.sensor('temperature', name)['temperature'] - 20 for name in ('warm', 'cold'))
    capacity = 1.204 * 1006
    gained = capacity * 2.5 * 4 * 2.95 * (warm + cold)
    assert gained == pytest.approx(1000 * w.time, rel=0.02)      # nothing is lost on the way
    assert cold > 0.2 * warm if opens else cold == pytest.approx(0, abs=1e-9)


def test_outside_of_all_rooms_it_is_as_cold_as_outside(world):
    w = world(air('0 0 0 4 3 2.5') + include('temperature_sensor', 't', '-2 0 1 0 0 0'))
    w.command('climate', 'flat', 'Outside -7.5')
    w.run(1.1)
    assert w.sensor('temperature', 't')['temperature'] == -7.5


# battery

ROBOTS = '<plugin name="r" filename="librobot_controller.so"><wheelDiameter>0.0704</wheelDiameter>'\
    '</plugin>'


def drive(world: angen.World, seconds: float, speed: float = 0.3, turn: float = 0.2) -> None:
    for _ in range(round(seconds / 0.5)):
        world.command('drive', 'robot', values=[speed, turn])
        world.run(0.5)


def test_the_charge_falls_by_the_energy_used(world):
    """Three starts to 0.5 m/s take m v^2 / 2 each, and nothing else takes work on a level floor."""
    w = world(include('turtlebot', 'robot', '0 0 0.001 0 0 0'), ROBOTS)
    w.run(1.1)
    before = w.device('battery', 'robot_battery')
    for _ in range(3):
        drive(w, 2, 0.5, 0.0)
        w.run(2)
    after = w.device('battery', 'robot_battery')
    work = w.device('drive', 'robot')['work']
    assert work == pytest.approx(3 * 6.3 * 0.5 ** 2 / 2, rel=0.05)
    used = (before['charge'] - after['charge']) * 3600 * 14.8
    assert used - 10.0 * 12 == pytest.approx(work / 0.6, rel=1e-6)    # 10 W for 12 s


def test_an_empty_battery_stops_the_robot(world):
    w = world(include('turtlebot', 'robot', '0 0 0.001 0 0 0'), ROBOTS)
    drive(w, 2)
    assert w.device('drive', 'robot')['v'] == pytest.approx(0.3, abs=0.02)
    w.command('battery', 'robot_battery', 'Charge 0')
    drive(w, 2)
    assert w.device('battery', 'robot_battery')['empty']
    assert w.device('drive', 'robot')['v'] == pytest.approx(0, abs=1e-3)
    w.command('battery', 'robot_battery', 'Charge 50')
    drive(w, 3)
    assert w.device('drive', 'robot')['v'] == pytest.approx(0.3, abs=0.02)
