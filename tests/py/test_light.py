"""Light in users' worlds: readings of a luminosity sensor beside pictures of a camera,
behind doors and people, and by day.
"""
import numpy as np
import pytest

import angen

SIZE = 48  # pixels


def world_of(content: str) -> angen.World:
    """A world without a floor, sky or ambient light."""
    return angen.World.from_text(f'''<sdf version="1.9"><world name="w"><scene>
  <ambient>0 0 0 1</ambient><background>0 0 0 1</background></scene>{content}</world></sdf>''')


def slab(name: str, pose: str, size: str, color: str) -> str:
    """A static box."""
    box = f'<geometry><box><size>{size}</size></box></geometry>'
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <collision name="c">{box}</collision><visual name="v">{box}
  <material><diffuse>{color} 1</diffuse></material></visual></link></model>'''


def room(albedo: float = 0.7) -> str:
    """4 x 4 x 2.6 m of gray slabs about x = y = 2."""
    color = f'{albedo} {albedo} {albedo}'
    sides = [('2 2 -0.1', '4.4 4.4 0.2'), ('2 2 2.7', '4.4 4.4 0.2'), ('-0.1 2 1.3', '0.2 4.4 3'),
             ('4.1 2 1.3', '0.2 4.4 3'), ('2 -0.1 1.3', '4.4 0.2 3'), ('2 4.1 1.3', '4.4 0.2 3')]
    return ''.join(slab(f'side{i}', f'{at} 0 0 0', size, color)
                   for i, (at, size) in enumerate(sides))


def lux(name: str, pose: str) -> str:
    """A luminosity sensor without noise."""
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <sensor name="s" type="camera"><update_rate>10</update_rate>
  <plugin name="p" filename="libluminosity_sensor_controller.so"/></sensor></link></model>'''


CAMERA = f'''<model name="eye"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link">
  <sensor name="c" type="camera"><update_rate>10</update_rate><camera>
  <horizontal_fov>1.0471976</horizontal_fov><image><width>{SIZE}</width><height>{SIZE}</height>
  </image><clip><near>0.05</near><far>20</far></clip></camera>
  <plugin name="p" filename="libgazebo_ros_camera.so"/></sensor></link></model>'''

LAMP = '''<model name="hall_lamp0"><static>true</static><pose>0 0.3 2.6 0 0 0</pose>
  <link name="link"><light name="l" type="point"><diffuse>1 1 1</diffuse></light></link>
  <plugin name="p" filename="libros_plugin.so"><luminous_flux>2000</luminous_flux>
  <level>100</level></plugin></model>'''

WINDOW = '''<model name="study_window0"><static>true</static><pose>0.01 2 1.5 0 0 0</pose>
  <link name="pane"><light name="sky" type="point"><direction>1 0 0</direction>
  <angen:rectangle>1.4 1.0</angen:rectangle></light></link>
  <plugin name="p" filename="libdaylight_plugin.so"><area>1.4</area></plugin></model>'''


def luminances(image: np.ndarray) -> np.ndarray:
    """The mean over (h, w, 3) sRGB bytes of the cd/m^2 that a camera shows as L / (L + 10)."""
    v = image / 255.0
    linear = np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)
    return (10.0 * linear / (1.0 - linear)).mean(axis=(0, 1))


def test_the_one_pixel_view_is_the_mean_of_a_cameras_picture():
    w = world_of(slab('wall', '3 0.4 1 0 0 0', '0.1 2.5 2.2', '0.9 0.5 0.2') + CAMERA
                 + LAMP.replace('2000', '20000') + lux('l', '0 0 1 0 0 0'))
    w.request('camera', 'eye')
    w.step(1)
    reading = w.sensor('luminosity', 'l')
    seen = np.array([50.0 * c / (1.0 - c) for c in (reading['r'], reading['g'], reading['b'])])
    shown = luminances(w.sensor('camera', 'eye')['image'])
    # the sensor looks in some 600 directions where the camera has 2304 pixels
    assert seen[0] > 10.0
    np.testing.assert_allclose(seen, shown, rtol=0.05)


def test_in_a_room_pictures_show_the_light_of_walls():
    content = room() + CAMERA.replace('0 0 1 0', '0.2 1.2 1.1 0') \
        + LAMP.replace('0 0.3 2.6', '1 2.5 2.2')
    shown = []
    for sensor in ('', lux('l', '0.2 1.2 1.1 0 0 0')):
        w = world_of(content + sensor)
        w.request('camera', 'eye')
        w.run(0.2)
        shown.append(luminances(w.sensor('camera', 'eye')['image']))
    reading = w.sensor('luminosity', 'l')
    seen = np.array([50.0 * c / (1.0 - c) for c in (reading['r'], reading['g'], reading['b'])])
    np.testing.assert_allclose(seen, shown[1], rtol=0.05)
    assert (shown[0] < 0.7 * seen).all()  # nothing is known of reflections without a light sensor


def test_daylight_follows_its_command():
    w = world_of(room() + WINDOW + lux('l', '3.9 2 1.5 0 0 3.1415926'))
    w.step(1)
    assert w.sensor('luminosity', 'l')['illuminance'] == 0.0
    readings = []
    for outdoors in (10000, 2500):
        w.command('daylight', 'all', f'Set {outdoors}')
        w.run(0.2)
        readings.append(w.sensor('luminosity', 'l')['illuminance'])
        assert w.device('daylight', 'study0')['luminous_flux'] == pytest.approx(0.49 * outdoors)
    # the pane's flux is L pi A; straight before it it gives about L A / d^2, and reflections more
    assert readings[0] > 10000 * 0.49 / np.pi / 3.89 ** 2
    assert readings[1] == pytest.approx(readings[0] / 4, rel=1e-6)
    with pytest.raises(angen.Error, match='daylight takes Set <0 to 100000 lux>'):
        w.command('daylight', 'study0', 'Set -1')


CABINET = '''<model name="cabinet"><static>{static}</static><pose>0.3 3.2 1 0 0 0</pose>
  <link name="link"><collision name="c"><geometry><box><size>0.6 1.2 2</size></box></geometry>
  </collision><visual name="v"><geometry><box><size>0.6 1.2 2</size></box></geometry><material>
  <diffuse>0.1 0.1 0.1 1</diffuse></material></visual></link></model>'''


def test_a_cabinet_that_could_move_lights_the_room_as_one_that_cannot():
    readings = {}
    for static in ('true', 'false'):
        w = world_of(room(0.8) + LAMP.replace('0 0.3 2.6', '2 2 2.2')
                     + lux('l', '0.05 1 2 0 0 0') + CABINET.format(static=static))
        w.step(1)
        first = w.sensor('luminosity', 'l')['illuminance']
        w.run(6.0)
        readings[static] = first, w.sensor('luminosity', 'l')['illuminance']
    assert readings['false'] == pytest.approx(readings['true'], rel=0.005)
    without = world_of(room(0.8) + LAMP.replace('0 0.3 2.6', '2 2 2.2')
                       + lux('l', '0.05 1 2 0 0 0'))
    without.step(1)
    assert without.sensor('luminosity', 'l')['illuminance'] > 1.1 * readings['true'][0]


def readings_of(building, pieces):
    """Readings each second while a lamp is lit and a door shuts; `pieces` are the lengths of runs
    (s) that divide a second; with none, it steps.
    """
    w = angen.World(building)
    readings = []
    for second in range(6):
        if second == 1:
            w.command('lamp', 'kitchen0', 'On')
            w.command('door', 'kitchen0', 'Close')
        for piece in pieces:
            w.run(piece)
        if not pieces:
            w.step(1000)
        readings.append([w.sensor('luminosity', name).get('illuminance')
                         for name in ('kitchen_lux0', 'entrance_lux0')])
    return readings, w.events()


def test_light_does_not_depend_on_how_time_is_divided(building):
    pieces = readings_of(building, [0.013, 0.287, 0.7])
    assert pieces == readings_of(building, [])
    assert pieces[0][1][0] > 10.0  # at once
    assert pieces[0][-1][1] < 0.5 * pieces[0][1][1]  # the door is shut


def test_a_warm_lamp_is_redder_than_a_cold_one_and_as_bright():
    seen = []
    for kelvin in (2700, 6500):
        warm = f'<angen:color_temperature>{kelvin}</angen:color_temperature></light>'
        w = world_of(room() + LAMP.replace('0 0.3 2.6', '2 2 2.2').replace('</light>', warm)
                     + lux('l', '0.05 2 1.5 0 0 0') + CAMERA)
        w.request('camera', 'eye')
        w.step(1)
        reading = w.sensor('luminosity', 'l')
        picture = luminances(w.sensor('camera', 'eye')['image'])
        seen.append((reading['illuminance'], reading['r'] / reading['b'], picture[0] / picture[2]))
    assert seen[0][0] == pytest.approx(seen[1][0], rel=1e-3)
    assert seen[0][1] > 1.3 * seen[1][1]
    assert seen[0][2] > 1.5 * seen[1][2]


@pytest.mark.parametrize('shape, message', [
    ('<angen:tube>1.2</angen:tube>', 'angen:tube'),
    ('<angen:sphere>-1</angen:sphere>', 'angen:sphere'),
    ('<angen:disc>1</angen:disc><angen:tube>1 0.1</angen:tube>', 'give one of them'),
    ('<angen:half_angle>2</angen:half_angle>', 'from 0.01 to 1.55 rad'),
    ('<angen:color_temperature>100</angen:color_temperature>', 'from 1667 to 25000 K'),
    ('<angen:ies/>', 'has no <uri>'),
    ('<angen:ies><uri>model://nowhere/x.ies</uri></angen:ies>', 'is not found')])
def test_a_wrong_source_is_an_error(shape, message):
    with pytest.raises(angen.Error, match=message):
        world_of(LAMP.replace('</light>', shape + '</light>'))


def test_a_broken_ies_file_is_an_error_with_its_line(tmp_path):
    (tmp_path / 'lamp.ies').write_text('IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 x 1 1 2 0 0 0\n')
    world = tmp_path / 'w.world'
    ies = '<angen:ies><uri>lamp.ies</uri></angen:ies></light>'
    world.write_text(f'<sdf version="1.9"><world name="w">{LAMP.replace("</light>", ies)}'
                     '</world></sdf>')
    with pytest.raises(angen.Error, match=r"lamp.ies:3: 'x' is not a number"):
        angen.World(str(world))
    outside = tmp_path.parent / 'secret.ies'
    outside.write_text('IESNA:LM-63-2002\n')
    world.write_text(world.read_text().replace('lamp.ies', str(outside)))
    with pytest.raises(angen.Error, match='allow'):
        angen.World(str(world))


def test_a_flat_light_needs_two_lengths():
    with pytest.raises(angen.Error, match='angen:rectangle'):
        world_of(WINDOW.replace('1.4 1.0', '1.4'))
