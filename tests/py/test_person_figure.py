"""Cameras see a person whose legs swing while it walks, and hang down while it stands."""
import numpy as np

import angen

WORLD = """<sdf version="1.6"><world name="w">
  <model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane>
    <normal>0 0 1</normal></plane></geometry></collision></link></model>
  <actor name="ann"><pose>-2 0 0 0 0 0</pose></actor>
  <model name="eye"><static>true</static><pose>0 -3 0.9 0 0 1.5708</pose><link name="l">
    <sensor name="eye" type="depth"><update_rate>20</update_rate><camera>
      <horizontal_fov>1.4</horizontal_fov><image><width>160</width><height>120</height></image>
      <clip><near>0.1</near><far>6</far></clip></camera>
      <plugin name="eye" filename="libgazebo_ros_openni_kinect.so"/></sensor></link></model>
</world></sdf>"""


def legs(world: angen.World) -> int:
    """The width of the figure below its hands, in pixels."""
    depths = np.asarray(world.sensor('depth', 'eye')['depth'])
    return int(np.ptp(np.nonzero(np.isfinite(depths[85:]).any(axis=0))[0]))


def test_legs_swing_apart_on_the_way_and_hang_down_at_its_end(tmp_path):
    path = tmp_path / 'figure.world'
    path.write_text(WORLD)
    world = angen.World(str(path))
    world.request('depth', 'eye')
    world.run(0.5)
    world.command('person', 'ann', 'GoTo 0.5 0')
    widths = []
    for _ in range(20):
        world.run(0.1)
        widths.append(legs(world))
    world.run(5.0)
    stands = legs(world)
    assert max(widths) > 1.7 * stands
    assert min(widths[5:]) < 1.3 * stands  # legs pass each other
