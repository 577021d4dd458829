"""Special files named as models and meshes are not read, and the node answers afterwards."""
from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from harness import WORLD, Master, end

MESH = ('<sdf version="1.6"><model name="m"><link name="l"><collision name="c"><geometry>'
        '<mesh><uri>file://{}</uri></mesh></geometry></collision></link></model></sdf>')
INCLUDE = '<sdf version="1.6"><include><uri>file://{}</uri></include></sdf>'


def test_eight_calls_with_special_files_leave_the_node_answering(
        master: Master, rospy_node: None, tmp_path: Path) -> None:
    from gazebo_msgs.srv import GetWorldProperties, SpawnModel
    pipe = tmp_path / 'pipe.stl'
    os.mkfifo(pipe)
    files = ['/proc/kmsg', '/dev/zero', '/dev/tty', str(pipe)]

    with master.serving(WORLD, tmp_path, allow_paths='true') as node:
        def spawn(number: int) -> Any:
            text = (MESH if number % 2 else INCLUDE).format(files[number // 2])
            return node.call('/gazebo/spawn_sdf_model', SpawnModel, model_name=f'm{number}',
                             model_xml=text)

        with ThreadPoolExecutor(8) as clients:
            answers = list(clients.map(spawn, range(8)))
        for number, answer in enumerate(answers):
            assert answer.success == bool(number % 2)  # a mesh is left out, with a warning
            assert files[number // 2] in answer.status_message
            assert 'is not a regular file' in answer.status_message, answer.status_message
        models = node.call('/gazebo/get_world_properties', GetWorldProperties).model_names
        assert {f'm{number}' for number in range(8)} & set(models) == {'m1', 'm3', 'm5', 'm7'}
        assert end(node.process) == 0
