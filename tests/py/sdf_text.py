"""Pieces of SDF for the tests of `import angen`."""
from pathlib import Path

WORLDS = Path(__file__).resolve().parents[2] / 'worlds'


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


def pir(name: str, pose: str, extra: str = '') -> str:
    """A static model with one PIR of 9 x 1 rays over 60 degrees, without noise."""
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <sensor name="pir" type="ray"><update_rate>10</update_rate><ray><scan><horizontal>
  <samples>9</samples><min_angle>-0.5236</min_angle><max_angle>0.5236</max_angle></horizontal></scan>
  <range><min>0.05</min><max>6</max></range></ray>
  <plugin name="pir" filename="libpir_controller.so">{extra}</plugin></sensor></link></model>'''
