"""The node that publishes maps: latched, one a floor."""
import signal
import subprocess
from pathlib import Path

import numpy as np
import psutil
import pytest
from angen_apps.maps.gridmap import load_world, make_map
from harness import Angen, Master, end, until
from nav_msgs.msg import MapMetaData, OccupancyGrid
from nav_msgs.srv import GetMap, LoadMap, LoadMapResponse
from tf2_msgs.msg import TFMessage

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / 'src/angen_apps/scripts/map_publisher'


def storey(floor: int, length: float) -> str:
    """A slab of 4 x 4 m with two walls that cross on it."""
    return ''.join(f'''<model name="{name}{floor}"><static>true</static>
  <pose>0 0 {4 * floor + z} 0 0 0</pose><link name="link"><collision name="c">
  <geometry><box><size>{size}</size></box></geometry></collision></link></model>'''
                   for name, z, size in (('slab', -0.1, '4 4 0.2'),
                                         ('wall', 0.5, f'{length} 0.1 1'),
                                         ('across', 0.5, f'0.1 {length} 1')))


def start(master: Master, world: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(['/usr/bin/python3', str(SCRIPT), str(world)], text=True,
                            env=master.environment, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)


@pytest.fixture
def two_floors(tmp_path: Path) -> Path:
    path = tmp_path / 'two.world'
    path.write_text(f'<sdf version="1.6"><world name="w">{storey(0, 3)}{storey(1, 2)}'
                    '</world></sdf>')
    return path


def test_each_floor_has_its_map(angen: Angen, two_floors: Path) -> None:
    process = start(angen.master, two_floors)
    try:
        for topic, floor in (('/map', 0), ('/floor0/map', 0), ('/floor1/map', 1)):
            message = angen.wait(topic, OccupancyGrid)
            grid = make_map(load_world(str(two_floors)), floor)
            assert message.header.frame_id == 'world'
            assert message.info.resolution == pytest.approx(0.05)
            corner = message.info.origin
            assert (corner.position.x, corner.position.y) == pytest.approx(grid.origin)
            assert corner.position.z == 4 * floor and corner.orientation.w == 1
            cells = np.reshape(message.data, (message.info.height, message.info.width))
            assert (cells == grid.cells).all() and set(message.data) == {-1, 0, 100}
        assert '/floor2/map' not in angen.master.topics()
    finally:
        process.stderr.close()
        assert end(process) == 0


def cells(message: OccupancyGrid) -> tuple[str, MapMetaData, tuple[int, ...]]:
    """A map without its header's number, which each publisher counts for itself."""
    return message.header.frame_id, message.info, tuple(message.data)


def params(master: Master, **values: str) -> None:
    for name, value in values.items():
        master.api.setParam('/test', f'/map_publisher/{name}', value)


def test_it_serves_one_floor_as_map_server_does(angen: Angen, two_floors: Path) -> None:
    process = start(angen.master, two_floors)
    try:
        angen.wait('/floor1/map', OccupancyGrid)
        first = cells(angen.call('/static_map', GetMap).map)
        lower, upper = (cells(angen.wait(f'/floor{n}/map', OccupancyGrid)) for n in (0, 1))
        assert first == cells(angen.wait('/map', OccupancyGrid)) == lower != upper
        assert angen.wait('/map_metadata', MapMetaData) == first[1]
        rejected = angen.call('/change_map', LoadMap, map_url='floor7')
        assert rejected.result == LoadMapResponse.RESULT_MAP_DOES_NOT_EXIST
        assert cells(angen.call('/static_map', GetMap).map) == lower
        changed = angen.call('/change_map', LoadMap, map_url='floor1')
        assert changed.result == LoadMapResponse.RESULT_SUCCESS
        assert cells(changed.map) == upper == cells(angen.call('/static_map', GetMap).map)
        angen.wait('/map', OccupancyGrid, lambda m: cells(m) == upper)
    finally:
        process.stderr.close()
        assert end(process) == 0


def test_in_a_frame_of_its_own_the_map_is_level_with_its_floor(angen: Angen, two_floors: Path
                                                               ) -> None:
    params(angen.master, frame_id='map')
    process = start(angen.master, two_floors)
    try:
        for floor in (0, 1):
            angen.call('/change_map', LoadMap, map_url=f'floor{floor}')
            grid = angen.wait('/map', OccupancyGrid)
            assert (grid.header.frame_id, grid.info.origin.position.z) == ('map', 0)
            shown = angen.wait('/tf_static', TFMessage, lambda m: any(
                t.child_frame_id == 'map' for t in m.transforms))
            placed, = (t for t in shown.transforms if t.child_frame_id == 'map')
            assert placed.header.frame_id == 'world'
            assert placed.transform.translation.z == 4 * floor
            assert angen.wait(f'/floor{floor}/map', OccupancyGrid).header.frame_id == 'world'
    finally:
        angen.master.api.deleteParam('/test', '/map_publisher/frame_id')
        process.stderr.close()
        assert end(process) == 0


def test_without_floors_it_ends(angen: Angen) -> None:
    process = start(angen.master, ROOT / 'worlds/empty.world')
    assert process.communicate(timeout=60) and process.returncode == 0
    assert '/floor0/map' not in angen.master.topics()


def test_a_world_that_does_not_load_is_one_line(angen: Angen, tmp_path: Path) -> None:
    process = start(angen.master, tmp_path / 'none.world')
    said, errors = process.communicate(timeout=60)
    assert process.returncode == 1
    assert not errors  # roslaunch would show it beside the error of the node
    line, = said.splitlines()
    assert line.startswith('map_publisher: ') and 'none.world' in line


def test_ctrl_c_is_quiet(angen: Angen, two_floors: Path) -> None:
    process = start(angen.master, two_floors)
    angen.wait('/floor1/map', OccupancyGrid)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=60)[1] == '' and process.returncode == 0


@pytest.mark.parametrize('how', [signal.SIGINT, signal.SIGKILL])
def test_ended_early_it_leaves_nothing_behind(angen: Angen, how: int) -> None:
    process = start(angen.master, ROOT / 'worlds/angen.world')
    helper, = until(psutil.Process(process.pid).children, 'a process makes the maps')
    process.send_signal(how)
    process.communicate(timeout=60)
    until(lambda: not helper.is_running() or helper.status() == psutil.STATUS_ZOMBIE, 'it ends')
