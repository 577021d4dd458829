"""~allow_paths of the node: a world's models may name files anywhere."""
from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from harness import Master, node_binary


@pytest.mark.parametrize('allow, said', [
    (False, 'w.world:2: model'),
    (True, '~rate is -1'),  # it checks that once the world is loaded
])
def test_a_model_from_elsewhere_is_loaded_where_allowed(master: Master, tmp_path: Path,
                                                        allow: bool, said: str) -> None:
    (tmp_path / 'outside').mkdir()
    (tmp_path / 'outside/m.sdf').write_text(
        '<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>')
    (tmp_path / 'home').mkdir()
    world = tmp_path / 'home/w.world'
    world.write_text('<sdf version="1.6"><world name="w">\n<include><uri>file://'
                     f'{tmp_path}/outside/m.sdf</uri></include></world></sdf>')
    done = subprocess.run(
        [str(node_binary()), str(world), f'_allow_paths:={str(allow).lower()}', '_rate:=-1',
         '__name:=allow_paths'],
        env=master.environment, text=True, capture_output=True, timeout=60)
    assert done.returncode == 1
    assert said in done.stderr, done.stderr
