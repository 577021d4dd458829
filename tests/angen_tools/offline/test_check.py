"""angen check."""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'
SNIPPETS = ROOT / 'tests/angen_sim/sdf/snippets'
MODEL = '''<sdf version="1.6"><model name="ground_plane"><static>true</static>
<link name="l"><sensor name="s" type="ray"><plugin name="p" filename="libpir_controller.so"/>
</sensor></link></model></sdf>'''


def angen(*words: str, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *words], text=True, timeout=60,
                          stdin=subprocess.DEVNULL, **{'capture_output': True, **options})


def test_check_of_a_right_world() -> None:
    done = angen('check', str(ROOT / 'worlds/empty.world'))
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.endswith('no errors; 1 model, 0 devices, 0 sensors\n')


def test_check_of_a_pipe_does_not_wait_for_a_writer(tmp_path: Path) -> None:
    pipe = tmp_path / 'pipe.world'
    os.mkfifo(pipe)
    done = angen('check', str(pipe))
    assert done.returncode == 1
    assert str(pipe) in done.stderr


def test_check_of_a_broken_world_names_file_and_line(tmp_path: Path) -> None:
    broken = tmp_path / 'broken.world'
    broken.write_text('<sdf version="1.6"><world name="w">\n'
                      '<include><uri>model://no_such_model</uri></include>\n</world></sdf>')
    done = angen('check', str(broken))
    assert done.returncode == 1 and done.stdout == ''
    line, = done.stderr.splitlines()
    assert line.startswith(f'{broken}:2: ') and 'no_such_model' in line


def test_check_of_the_worlds_includes_under_the_names_of_the_source() -> None:
    done = angen('check', str(SNIPPETS / 'two_floors.world'))
    assert (done.returncode, done.stderr) == (0, '')
    assert '15 models, 15 devices, 1 sensor' in done.stdout


def test_check_finds_the_models_beside_one_and_says_so(tmp_path: Path) -> None:
    for name in ('part', 'whole'):
        (tmp_path / name).mkdir()
        (tmp_path / name / 'model.config').write_text(
            '<model><name>x</name><sdf version="1.6">model.sdf</sdf></model>')
    (tmp_path / 'part/model.sdf').write_text(MODEL)
    whole = tmp_path / 'whole/model.sdf'
    whole.write_text('<sdf version="1.6"><model name="whole"><include><uri>model://part</uri>'
                     '</include></model></sdf>')
    plain = {**os.environ, 'GAZEBO_MODEL_PATH': ''}
    for path in (whole, whole.parent):
        done = angen('check', str(path), env=plain)
        assert done.returncode == 0, done.stderr
        assert f'add {tmp_path} to GAZEBO_MODEL_PATH' in done.stdout + done.stderr
    done = angen('check', str(whole), env={**plain, 'GAZEBO_MODEL_PATH': str(tmp_path)})
    assert (done.returncode, done.stderr) == (0, '')
    assert 'GAZEBO_MODEL_PATH' not in done.stdout
    (whole.parent / 'model.config').unlink()  # then it is a file somewhere
    assert angen('check', str(whole), env=plain).returncode == 1


def test_check_of_a_model_whose_declaration_follows_a_comment(tmp_path: Path) -> None:
    file = tmp_path / 'late.sdf'
    file.write_text(f'<!-- of the author -->\n<?xml version="1.0"?>\n{MODEL}')
    done = angen('check', str(file))
    assert (done.returncode, done.stderr) == (0, '')
    assert 'model ground_plane with 1 link' in done.stdout


def test_check_of_a_model_as_file_as_folder_and_by_its_address(tmp_path: Path) -> None:
    (tmp_path / 'model.sdf').write_text(MODEL)
    (tmp_path / 'model.config').write_text(
        '<model><name>x</name><sdf version="1.6">model.sdf</sdf></model>')
    for path in (tmp_path, tmp_path / 'model.sdf'):
        done = angen('check', str(path))
        assert (done.returncode, done.stderr) == (0, '')
        assert done.stdout == (f'{path}: no errors; model ground_plane with 1 link, '
                               '0 joints, 0 devices, 1 sensor (pir ground_plane)\n')
    done = angen('check', 'model://bath_door0')
    assert '1 device (door bathroom0)' in done.stdout


def test_check_of_a_model_that_names_its_own_files(tmp_path: Path) -> None:
    folder = tmp_path / 'crate'
    folder.mkdir()
    (folder / 'crate.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
    (folder / 'model.sdf').write_text(
        '<sdf version="1.6"><model name="crate"><link name="l"><visual name="v"><geometry><mesh>'
        '<uri>model://crate/crate.obj</uri></mesh></geometry></visual></link></model></sdf>')
    done = angen('check', str(folder / 'model.sdf'))
    assert (done.returncode, done.stderr) == (0, '')


def test_check_of_a_urdf() -> None:
    done = angen('check', str(SNIPPETS / 'robot.urdf'))
    assert (done.returncode, done.stderr) == (0, '')
    assert 'model robot with 3 links, 2 joints, 1 device (drive robot)' in done.stdout


def test_check_of_several_continues_after_an_error(tmp_path: Path) -> None:
    broken = tmp_path / 'broken.urdf'
    broken.write_text('<robot name="r">\n<link/></robot>')
    missing = tmp_path / 'missing.sdf'
    done = angen('check', str(broken), str(SNIPPETS / 'robot.urdf'), str(missing))
    assert done.returncode == 1
    assert 'no errors' in done.stdout and len(done.stdout.splitlines()) == 1
    first, second = done.stderr.splitlines()
    assert first.startswith(f'{broken}:2: ')
    assert second.startswith(f'{missing}: ') and 'exists' in second


def test_check_shows_warnings_and_succeeds(tmp_path: Path) -> None:
    model = tmp_path / 'model.sdf'
    model.write_text('<sdf version="1.6"><model name="m">\n<pose>1 0 0</pose>'
                     '<link name="l"/></model></sdf>')
    done = angen('check', str(model))
    assert done.returncode == 0 and 'loads with 1 warning; model m' in done.stdout
    assert done.stderr.startswith(f'warning: {model}:2: <pose> contains 3 numbers')


def test_check_lists_ignored_elements(tmp_path: Path) -> None:
    model = tmp_path / 'model.sdf'
    model.write_text('<sdf version="1.6"><model name="m">\n<enable_wind>true</enable_wind>\n'
                     '<link name="l"/></model></sdf>')
    done = angen('check', str(model))
    assert (done.returncode, done.stderr) == (0, '')
    first, second = done.stdout.splitlines()
    assert first == f'ignored: {model}:2: <enable_wind> in <model>'
    assert 'no errors; model m' in second


@pytest.mark.parametrize('words', [['check'], ['check', '--no-such-option', 'x']])
def test_wrong_words_end_with_2(words: list[str]) -> None:
    assert angen(*words).returncode == 2


def test_an_empty_path_is_named() -> None:
    done = angen('check', '')
    assert (done.returncode, done.stdout) == (1, '')
    assert done.stderr == "'': not a path; give a file, a folder or model://NAME\n"
