"""The motion of an elevator in a recording."""
from pathlib import Path

import angen

from angen_apps.data.cabins import Cabins, Slide

WORLD = """<sdf version="1.6"><world name="w">
<include><uri>model://elevator</uri><name>lift</name></include>
<plugin name="elevator" filename="libros_plugin.so"/></world></sdf>"""


def ride(world: angen.World, cabins: Cabins, seconds: float) -> list[Slide]:
    """A recording of some time, sampled every half a second."""
    before = len(cabins.slides)
    end = world.time + seconds
    while world.time < end:
        world.run(0.5)
        for time, source, kind, _, _ in world.events():
            if kind == 'elevator':
                cabins.event(float(time), source)
        cabins.look()
    return cabins.slides[before:]


def test_a_ride_is_recorded_until_it_ends(tmp_path: Path) -> None:
    path = tmp_path / 'w.world'
    path.write_text(WORLD)
    world = angen.World(str(path))
    cabins = Cabins(world)
    links = {name.split('::')[1] for name in world.links}
    assert {slide.link for slide in cabins.slides} == links and cabins.slides[0].time == 0.0
    ride(world, cabins, 5.0)
    name = world.entities('elevator')[0][1]
    world.command('elevator', name, 'Floor1')
    slides = ride(world, cabins, 60.0)
    heights = [slide.z for slide in slides if slide.link == 'cabin']
    assert len(heights) > 5 and heights == sorted(heights)
    poses = {link: tuple(pose[:3]) for link, pose in zip(world.links, world.link_poses)}
    last = {slide.link: slide for slide in cabins.slides}
    for link, pose in poses.items():
        assert max(abs(a - b) for a, b in zip(last[link.split('::')[1]][3:], pose)) < 0.003
    assert poses['lift::cabin'][2] > 2.0
    assert max(slide.time for slide in slides) < world.time - 5.0
    assert ride(world, cabins, 20.0) == []  # it rests
