"""gzserver's and spawn_model's words, without a master."""
import io
import math
from pathlib import Path

import angen
import pytest
import rospkg
from gazebo_ros import server, spawn


def words(*given: str) -> list[str]:
    return server.node_words(list(given))


def test_gzserver_starts_the_node_with_the_world_below_the_resource_path(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world = tmp_path / 'worlds/hall.world'
    world.parent.mkdir()
    world.write_text('<sdf version="1.6"><world name="w"/></sdf>')
    monkeypatch.setenv('GAZEBO_RESOURCE_PATH', str(tmp_path))
    made = words('-u', '--verbose', '-e', 'ode', '-s', 'libgazebo_ros_api_plugin.so', '--seed', '7',
                 'worlds/hall.world', '__name:=gazebo')
    assert made[0].endswith('angen_node')
    assert made[1:] == [str(world), '_odom_parent:=none', '_strict:=false', '_paused:=true',
                        '_seed:=7', '_record:=', '__name:=gazebo']


def test_gzserver_overrides_the_parameters_of_an_earlier_one() -> None:
    assert words()[4:] == ['_paused:=false', '_seed:=1', '_record:=']


def test_gzserver_has_an_empty_world_also_in_place_of_one_that_is_missing(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
        capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    own = words()[1]
    assert Path(own).name == 'empty.world' and Path(own).is_file()
    assert words('worlds/missing.world')[1] == own
    assert 'no world worlds/missing.world; searched' in capsys.readouterr().err


def test_an_unknown_option_and_engine_are_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    assert words('--warp', '-e', 'bullet')[1].endswith('empty.world')
    printed = capsys.readouterr().err
    assert '--warp is not known' in printed and 'ODE is the one engine' in printed


def options(*given: str) -> object:
    return spawn.parser('/bot').parse_args(['-model', 'm', *given])


def test_spawn_model_reads_every_option() -> None:
    made = spawn.parser('/bot').parse_args(
        '-urdf -param robot_description -model m  -x 1 -y 2 -z 3 -R 0.1 -P 0.2 -Y 0.3 -J a 1.5'
        ' -J b 2 -reference_frame map -unpause -wait other -package_to_model -b'.split())
    assert made.robot_namespace == '/bot' and made.gazebo_namespace == '/gazebo'
    assert spawn.joint_positions(made.joints) == {'a': 1.5, 'b': 2.0}
    pose = spawn.pose_of(made)
    assert (pose.position.x, pose.position.y, pose.position.z) == (1, 2, 3)
    q = pose.orientation
    yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y ** 2 + q.z ** 2))
    assert yaw == pytest.approx(0.3)
    assert math.asin(2 * (q.w * q.y - q.z * q.x)) == pytest.approx(0.2)


def test_spawn_model_reads_files_the_model_path_and_stdin(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / 'a.urdf'
    file.write_text('<robot name="r"><link name="l"><visual><geometry>'
                    '<mesh filename="package://p/a.dae"/></geometry></visual></link></robot>')
    assert spawn.read_xml(options('-urdf', '-file', str(file))) == file.read_text()
    changed = spawn.read_xml(options('-urdf', '-package_to_model', '-file', str(file)))
    assert 'model://p/a.dae' in changed
    assert '<uri>model://cafe_table</uri>' in spawn.read_xml(options('-sdf', '-database',
                                                                     'cafe_table'))
    monkeypatch.setattr('sys.stdin', io.StringIO('<sdf/>'))
    assert spawn.read_xml(options('-sdf', '-stdin')) == '<sdf/>'


@pytest.mark.parametrize('text, said', [('', 'empty'), ('<a>', 'not well-formed')])
def test_spawn_model_reports_the_error_of_a_file(tmp_path: Path, text: str, said: str) -> None:
    file = tmp_path / 'a.sdf'
    file.write_text(text)
    with pytest.raises(spawn.Failure, match=said):
        spawn.read_xml(options('-sdf', '-file', str(file)))
    with pytest.raises(spawn.Failure, match='No such file'):
        spawn.read_xml(options('-sdf', '-file', str(tmp_path / 'missing')))


@pytest.mark.parametrize('name', ['shapes', 'willowgarage', 'rubble', 'mud', 'range', 'elevator'])
def test_gazebos_worlds_exist_by_their_names(name: str) -> None:
    world = angen.World(words(f'worlds/{name}.world')[1])
    world.run(1.0)
    assert world.warnings == [] and len(world.models) > 1
    launch = server.own_folder() / 'launch' / f'{name}_world.launch'
    assert f'worlds/{name}.world' in launch.read_text()


@pytest.mark.parametrize('name', ['gazebo_plugins', 'hector_gazebo_plugins'])
def test_packages_that_robots_depend_on_exist(name: str) -> None:
    assert rospkg.RosPack().get_manifest(name).license


def test_a_declaration_after_a_comment_is_taken_out(tmp_path: Path) -> None:
    file = tmp_path / 'a.sdf'
    file.write_text('<!-- by\nhand -->\n<?xml version="1.0"?>\n<sdf version="1.6"/>')
    assert spawn.read_xml(options('-sdf', '-file', str(file))).count('\n') == 3
