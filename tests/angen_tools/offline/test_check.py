"""angen check."""
import os
from pathlib import Path
from subprocess import CompletedProcess
from typing import Callable

import pytest

ROOT = Path(__file__).resolve().parents[3]
SNIPPETS = ROOT / 'tests/angen_sim/sdf/snippets'
MODEL = '''<sdf version="1.6"><model name="ground_plane"><static>true</static>
<link name="l"><sensor name="s" type="ray"><plugin name="p" filename="libpir_controller.so"/>
</sensor></link></model></sdf>'''


Command = Callable[..., CompletedProcess[str]]


def test_check_of_a_right_world(command: Command) -> None:
    done = command('check', str(ROOT / 'worlds/empty.world'))
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.endswith('no errors; 1 model, 0 devices, 0 sensors\n')


def test_check_of_a_pipe_does_not_wait_for_a_writer(command: Command, tmp_path: Path) -> None:
    pipe = tmp_path / 'pipe.world'
    os.mkfifo(pipe)
    done = command('check', str(pipe))
    assert done.returncode == 1
    assert str(pipe) in done.stderr


def test_check_of_the_worlds_includes_under_the_names_of_the_source(command: Command) -> None:
    done = command('check', str(SNIPPETS / 'two_floors.world'))
    assert (done.returncode, done.stderr) == (0, '')
    assert '15 models, 15 devices, 1 sensor' in done.stdout


def test_check_finds_the_models_beside_one_and_says_so(
        command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ('part', 'whole'):
        (tmp_path / name).mkdir()
        (tmp_path / name / 'model.config').write_text(
            '<model><name>x</name><sdf version="1.6">model.sdf</sdf></model>')
    (tmp_path / 'part/model.sdf').write_text(MODEL)
    whole = tmp_path / 'whole/model.sdf'
    whole.write_text('<sdf version="1.6"><model name="whole"><include><uri>model://part</uri>'
                     '</include></model></sdf>')
    monkeypatch.setenv('GAZEBO_MODEL_PATH', '')
    for path in (whole, whole.parent):
        done = command('check', str(path))
        assert done.returncode == 0, done.stderr
        assert f'add {tmp_path} to GAZEBO_MODEL_PATH' in done.stdout + done.stderr
    monkeypatch.setenv('GAZEBO_MODEL_PATH', str(tmp_path))
    done = command('check', str(whole))
    assert (done.returncode, done.stderr) == (0, '')
    assert 'GAZEBO_MODEL_PATH' not in done.stdout
    monkeypatch.setenv('GAZEBO_MODEL_PATH', '')
    (whole.parent / 'model.config').unlink()  # then it is a file somewhere
    assert command('check', str(whole)).returncode == 1


def test_check_of_a_model_whose_declaration_follows_a_comment(
        command: Command, tmp_path: Path) -> None:
    file = tmp_path / 'late.sdf'
    file.write_text(f'<!-- of the author -->\n<?xml version="1.0"?>\n{MODEL}')
    done = command('check', str(file))
    assert (done.returncode, done.stderr) == (0, '')
    assert 'model ground_plane with 1 link' in done.stdout


def test_check_of_a_model_as_file_as_folder_and_by_its_address(
        command: Command, tmp_path: Path) -> None:
    (tmp_path / 'model.sdf').write_text(MODEL)
    (tmp_path / 'model.config').write_text(
        '<model><name>x</name><sdf version="1.6">model.sdf</sdf></model>')
    for path in (tmp_path, tmp_path / 'model.sdf'):
        done = command('check', str(path))
        assert (done.returncode, done.stderr) == (0, '')
        assert done.stdout == (f'{path}: no errors; model ground_plane with 1 link, '
                               '0 joints, 0 devices, 1 sensor (pir ground_plane)\n')
    done = command('check', 'model://bath_door0')
    assert '1 device (door bathroom0)' in done.stdout


def test_check_of_a_model_that_names_its_own_files(command: Command, tmp_path: Path) -> None:
    folder = tmp_path / 'crate'
    folder.mkdir()
    (folder / 'crate.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
    (folder / 'model.sdf').write_text(
        '<sdf version="1.6"><model name="crate"><link name="l"><visual name="v"><geometry><mesh>'
        '<uri>model://crate/crate.obj</uri></mesh></geometry></visual></link></model></sdf>')
    done = command('check', str(folder / 'model.sdf'))
    assert (done.returncode, done.stderr) == (0, '')


def test_check_of_a_urdf(command: Command) -> None:
    done = command('check', str(SNIPPETS / 'robot.urdf'))
    assert (done.returncode, done.stderr) == (0, '')
    assert 'model robot with 3 links, 2 joints, 1 device (drive robot)' in done.stdout


def test_check_of_several_continues_after_an_error(command: Command, tmp_path: Path) -> None:
    broken = tmp_path / 'broken.urdf'
    broken.write_text('<robot name="r">\n<link/></robot>')
    missing = tmp_path / 'missing.sdf'
    done = command('check', str(broken), str(SNIPPETS / 'robot.urdf'), str(missing))
    assert done.returncode == 1
    assert 'no errors' in done.stdout and len(done.stdout.splitlines()) == 1
    first, second = done.stderr.splitlines()
    assert first.startswith(f'{broken}:2: ')
    assert second.startswith(f'{missing}: ') and 'exists' in second


def test_check_shows_warnings_and_succeeds(command: Command, tmp_path: Path) -> None:
    model = tmp_path / 'model.sdf'
    model.write_text('<sdf version="1.6"><model name="m">\n<pose>1 0 0</pose>'
                     '<link name="l"/></model></sdf>')
    done = command('check', str(model))
    assert done.returncode == 0 and 'loads with 1 warning; model m' in done.stdout
    assert done.stderr.startswith(f'warning: {model}:2: <pose> contains 3 numbers')


def test_check_lists_ignored_elements(command: Command, tmp_path: Path) -> None:
    model = tmp_path / 'model.sdf'
    model.write_text('<sdf version="1.6"><model name="m">\n<enable_wind>true</enable_wind>\n'
                     '<link name="l"/></model></sdf>')
    done = command('check', str(model))
    assert (done.returncode, done.stderr) == (0, '')
    first, second = done.stdout.splitlines()
    assert first == f'ignored: {model}:2: <enable_wind> in <model>'
    assert 'no errors; model m' in second
