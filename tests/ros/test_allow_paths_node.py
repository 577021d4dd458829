"""~allow_paths of the node: a world's models may name files anywhere."""
from pathlib import Path

import pytest
from harness import Master


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
    assert said in master.rejected(world, f'_allow_paths:={str(allow).lower()}', '_rate:=-1',
                                   '__name:=allow_paths')
