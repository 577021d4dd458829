"""Files and libraries that a world may name: those of the paths, unless every path is allowed."""
import re
from pathlib import Path

import pytest

import angen
from angen_tools.cli import main as cli

STL = '''solid s
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid s
'''
REJECTED = 'is neither on the model or resource path'


def model(inside: str) -> str:
    return f'<model name="m"><link name="l"/>{inside}</model>'


def in_world(content: str) -> str:
    return f'<sdf version="1.6"><world name="w">{content}</world></sdf>'


@pytest.fixture
def outside(tmp_path: Path) -> Path:
    """A model that is neither beside the world nor on a path."""
    (tmp_path / 'outside').mkdir()
    path = tmp_path / 'outside/model.sdf'
    path.write_text(f'<sdf version="1.6">{model("")}</sdf>')
    return path


@pytest.fixture
def world_file(tmp_path: Path, outside: Path) -> Path:
    (tmp_path / 'home').mkdir()
    path = tmp_path / 'home/w.world'
    path.write_text(in_world(f'<include><uri>file://{outside}</uri></include>'))
    return path


def test_a_world_names_no_file_elsewhere(world_file: Path) -> None:
    lenient = angen.World(str(world_file))
    warning, = lenient.warnings
    assert re.search(REJECTED, warning) and warning.startswith(f'{world_file}:1: ')
    assert lenient.models == []
    assert angen.World(str(world_file), allow_paths=True).models == ['m']
    world_file.write_text(world_file.read_text().replace('"w"', '"w" angen:strict="true"'))
    with pytest.raises(angen.Error, match=REJECTED) as error:
        angen.World(str(world_file))
    assert str(error.value).startswith(f'{world_file}:1: ')


def test_a_text_that_is_spawned_names_no_file_elsewhere(outside: Path) -> None:
    include = f'<include><uri>file://{outside}</uri></include>'
    world = angen.World.from_text(in_world(''))
    with pytest.raises(angen.Error, match=REJECTED):
        world.spawn(include)
    world.spawn(str(outside))  # which the user has named
    assert world.models == ['m']
    free = angen.World.from_text(in_world(''), allow_paths=True)
    free.spawn(include)
    assert free.models == ['m']


def test_a_plug_in_elsewhere_is_not_loaded(tmp_path: Path) -> None:
    library = tmp_path / 'libx.so'
    library.write_text('')
    text = in_world(model(f'<plugin name="p" filename="{library}"/>'))
    with pytest.raises(angen.Error, match='is not on the plug-in path'):
        angen.World.from_text(text)
    with pytest.raises(angen.Error, match='is not a shared library'):
        angen.World.from_text(text, allow_paths=True)


def test_a_python_plug_in_is_known_either_way() -> None:
    class Nothing(angen.Device):
        pass

    angen.register('nothing_at_all.py', 'nothing_at_all', Nothing)
    text = in_world(model('<plugin name="p" filename="nothing_at_all.py"/>'))
    for allow in (False, True):
        assert angen.World.from_text(text, allow_paths=allow).devices('nothing_at_all') == ['m']


def test_the_command_line_allows_every_path(world_file: Path, capsys: pytest.CaptureFixture[str],
                                            monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('ANGEN_ALLOW_PATHS', 'false')
    assert cli.run(['check', str(world_file)]) == 1
    assert REJECTED in capsys.readouterr().err
    cli.make_parser().parse_args(['check', '--allow-paths', str(world_file)])
    assert cli.run(['check', str(world_file)]) == 1, 'understood is not run'
    assert cli.run(['check', '--allow-paths', str(world_file)]) == 0


def test_a_damaged_mesh_does_not_end_python(tmp_path: Path) -> None:
    loop = ('<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
            '<library_visual_scenes><visual_scene id="s"><node id="a"><instance_node url="#a"/>'
            '</node></visual_scene></library_visual_scenes>'
            '<scene><instance_visual_scene url="#s"/></scene></COLLADA>')
    (tmp_path / 'loop.dae').write_text(loop)
    (tmp_path / 'good.stl').write_text(STL)
    world = angen.World.from_text(in_world(''))
    for name in ('loop.dae', 'good.stl'):
        path = tmp_path / f'{name}.sdf'
        path.write_text('<sdf version="1.6"><model name="m"><static>1</static><link name="l">\n'
                        f'<visual name="v"><geometry><mesh><uri>{name}</uri></mesh></geometry>'
                        '</visual></link></model></sdf>')
    with pytest.raises(angen.Error, match='loop.dae.sdf:2: mesh .* instances itself'):
        world.spawn(str(tmp_path / 'loop.dae.sdf'))
    world.spawn(str(tmp_path / 'good.stl.sdf'))
    assert world.models == ['m']
