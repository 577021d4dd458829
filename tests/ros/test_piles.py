"""Meshes in each other hold up neither calls nor the end of the node."""
import random
import struct
import time
from pathlib import Path

from harness import SLOWNESS, WORLD, Master, end

LONGEST = 20.0  # s: ODE alone takes minutes for a step


def write_hedgehog(path: Path, spikes: int = 3000) -> None:
    """An STL of long triangles through the middle, each of which crosses most others."""
    draw = random.Random(1)
    with path.open('wb') as out:
        out.write(b'\0' * 80 + struct.pack('<I', spikes))
        for _ in range(spikes):
            tip = [draw.gauss(0, 0.5) for _ in range(3)]
            aside = [draw.gauss(0, 0.02) for _ in range(3)]
            corners = [*tip, *(b - a for a, b in zip(tip, aside)),
                       *(-a - b for a, b in zip(tip, aside))]
            out.write(struct.pack('<12fH', 0, 0, 0, *corners, 0))


def hedgehog(path: Path) -> str:
    return f'''<sdf version="1.6"><model name="hedgehog"><link name="l"><inertial><mass>5</mass>
      </inertial><collision name="c"><geometry><mesh><uri>file://{path}</uri></mesh></geometry>
      </collision></link></model></sdf>'''


def test_tangled_meshes_hold_up_no_call_and_no_end(master: Master, rospy_node: None, tmp_path: Path
                                                   ) -> None:
    from gazebo_msgs.srv import GetWorldProperties, SpawnModel
    mesh = tmp_path / 'hedgehog.stl'
    write_hedgehog(mesh)
    longest = 0.0
    with master.serving(WORLD, tmp_path, allow_paths='true') as node:
        for i in range(8):
            start = time.monotonic()
            spawned = node.call('/gazebo/spawn_sdf_model', SpawnModel, model_name=f'hog{i}',
                                model_xml=hedgehog(mesh))
            assert spawned.success, spawned.status_message
            models = node.call('/gazebo/get_world_properties', GetWorldProperties).model_names
            longest = max(longest, time.monotonic() - start)
            assert f'hog{i}' in models
        print(f'tangled meshes: the longest two calls take {longest:.2f} s')
        assert longest < LONGEST * SLOWNESS
        start = time.monotonic()
        assert end(node.process) == 0
    print(f'it ends in {time.monotonic() - start:.2f} s')
    assert 'ODE' not in node.log()
