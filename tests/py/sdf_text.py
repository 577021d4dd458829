"""Pieces of SDF for the tests of `import angen`."""
from pathlib import Path

WORLDS = Path(__file__).resolve().parents[2] / 'worlds'
DOORS = '<plugin name="doors" filename="libdoor_world_plugin.so"/>'


def sdf_world(content: str, plugins: str = '') -> str:
    """An SDF world at 1 ms without friction of its own: a floor at z = 0 and `content`."""
    return f'''<sdf version="1.6"><world name="test">
  <physics type="ode"><max_step_size>0.001</max_step_size></physics>{plugins}
  <model name="floor"><static>true</static><link name="link"><collision name="box">
    <pose>0 0 -0.05 0 0 0</pose><geometry><box><size>20 20 0.1</size></box></geometry>
  </collision></link></model>{content}</world></sdf>'''


def box(name: str, pose: str, size: str, static: bool = False, mass: float = 1.0) -> str:
    """A box model; size in m, mass in kg, inertia of a solid box."""
    x, y, z = (float(v) for v in size.split())
    moments = [mass / 12 * v for v in (y * y + z * z, x * x + z * z, x * x + y * y)]
    return f'''<model name="{name}"><static>{str(static).lower()}</static><pose>{pose}</pose>
  <link name="link"><inertial><mass>{mass}</mass><inertia><ixx>{moments[0]}</ixx>
  <iyy>{moments[1]}</iyy><izz>{moments[2]}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
  <collision name="box"><geometry><box><size>{size}</size></box></geometry></collision></link>
  </model>'''


def rooms(*boxes: str) -> str:
    """Rooms room0, room1, … in a model; each box is x0 y0 z0 x1 y1 z1."""
    made = ''
    for i, text in enumerate(boxes):
        x0, y0, z0, x1, y1, z1 = (float(v) for v in text.split())
        made += (f'<angen:room name="room{i}"><angen:polygon>{x0} {y0} {x1} {y0} {x1} {y1} '
                 f'{x0} {y1}</angen:polygon><angen:floor>{z0}</angen:floor><angen:ceiling>'
                 f'{z1 - z0}</angen:ceiling></angen:room>')
    return made


def air(*boxes: str, extra: str = '') -> str:
    """A model `flat` of rooms with a climate."""
    return (f'<model name="flat"><static>true</static><link name="l"/>{rooms(*boxes)}'
            f'<plugin name="air" filename="libroom_climate.so">{extra}</plugin></model>')


def include(model: str, name: str, pose: str = '0 0 0 0 0 0', plugin: str = '') -> str:
    """A model of worlds/models in a world."""
    return (f'<include><uri>model://{model}</uri><name>{name}</name><pose>{pose}</pose>{plugin}'
            '</include>')


def person(pose: str, params: str = '', name: str = 'ann') -> str:
    return (f'<actor name="{name}"><pose>{pose}</pose><plugin name="person" '
            f'filename="libperson_controller.so">{params}</plugin></actor>')


def walker(name: str, *points: str, plugin: str = '') -> str:
    """A person who walks once from each "t x y" to the next."""
    way = ''.join(f'<waypoint><time>{t}</time><pose>{x} {y} 0 0 0 0</pose></waypoint>'
                  for t, x, y in (point.split() for point in points))
    return (f'<actor name="{name}"><script><loop>false</loop><trajectory id="0" type="walk">{way}'
            f'</trajectory></script>{plugin}</actor>')


def sensor(library: str, extra: str = '', rate: float = 10) -> str:
    """A sensor's element at its link's origin; the rate in Hz."""
    return (f'<sensor name="s" type="custom"><update_rate>{rate}</update_rate>'
            f'<plugin name="s" filename="{library}">{extra}</plugin></sensor>')


def device(name: str, library: str, extra: str = '', pose: str = '0 0 0 0 0 0') -> str:
    """A static model without a body, with one device."""
    return (f'<model name="{name}"><static>true</static><pose>{pose}</pose><link name="l"/>'
            f'<plugin name="d" filename="{library}">{extra}</plugin></model>')


def holder(name: str, sensor: str, pose: str = '0 0 0 0 0 0') -> str:
    """A static model without a body, with one sensor, which has its name."""
    return (f'<model name="{name}"><static>true</static><pose>{pose}</pose><link name="l">{sensor}'
            '</link></model>')


def pir(name: str, pose: str, extra: str = '') -> str:
    """A static model with one PIR of 9 x 1 rays over 60 degrees, without noise."""
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <sensor name="pir" type="ray"><update_rate>10</update_rate><ray><scan><horizontal>
  <samples>9</samples><min_angle>-0.5236</min_angle><max_angle>0.5236</max_angle></horizontal></scan>
  <range><min>0.05</min><max>6</max></range></ray>
  <plugin name="pir" filename="libpir_controller.so">{extra}</plugin></sensor></link></model>'''
