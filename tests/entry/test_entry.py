"""The shell entry: its errors where it cannot work, and whose python3 it uses."""
import fcntl
import os
from pathlib import Path
import shutil
import subprocess
import tempfile

import pytest

from angen_tools.cli.main import make_parser

ROOT = Path(__file__).resolve().parents[2]
DEBIAN_12 = 'ID=debian\nVERSION_ID="12"\n'


@pytest.fixture
def folder(tmp_path):
    """A folder that can be all of PATH: bash and sed, but neither apt-get nor sudo."""
    (tmp_path / 'bin').mkdir()
    for name in ('bash', 'sed'):
        (tmp_path / 'bin' / name).symlink_to(f'/usr/bin/{name}')
    return tmp_path


def program(path, text):
    """Writes an executable shell script."""
    path.write_text(f'#!/bin/sh\n{text}\n')
    path.chmod(0o755)


def require_installer(folder, os_release, user_id):
    """Runs the check that precedes every installation, on a machine as described."""
    (folder / 'os-release').write_text(os_release)
    return subprocess.run(
        ['/bin/bash', '-c', 'source "$1"; PATH=$2; require_installer "$3" "$4" 7; echo passed',
         'test', ROOT / 'angen', folder / 'bin', folder / 'os-release', str(user_id)],
        capture_output=True, text=True)


def assert_one_line(result, *words):
    assert result.returncode == 1
    assert result.stdout == ''
    assert len(result.stderr.splitlines()) == 1
    assert all(word in result.stderr for word in words), result.stderr


@pytest.mark.parametrize('os_release, name', [
    ('ID=ubuntu\nVERSION_ID="22.04"\n', 'ubuntu 22.04'),
    ('ID=debian\nVERSION_ID="13"\n', 'debian 13'),
    ('not a shell file (', 'unknown'),
])
def test_another_system_is_named_in_one_line(folder, os_release, name):
    assert_one_line(require_installer(folder, os_release, 0), 'needs Debian 12', name)


def test_missing_apt_is_named_in_one_line(folder):
    assert_one_line(require_installer(folder, DEBIAN_12, 0), 'needs apt-get')


def test_without_root_and_sudo_the_command_for_root_is_printed(folder):
    program(folder / 'bin' / 'apt-get', 'exit 0')
    result = require_installer(folder, DEBIAN_12, 1000)
    assert_one_line(result, '7 packages', 'sudo', 'apt-get install')


@pytest.mark.parametrize('user_id, programs', [(0, ['apt-get']), (1000, ['apt-get', 'sudo'])])
def test_debian_12_with_apt_passes(folder, user_id, programs):
    for name in programs:
        program(folder / 'bin' / name, 'exit 0')
    assert require_installer(folder, DEBIAN_12, user_id).stdout == 'passed\n'


@pytest.mark.parametrize('path', sorted(ROOT.glob('dependencies*.apt')), ids=lambda p: p.stem)
def test_every_dependency_has_a_purpose(path):
    lines = path.read_text().splitlines()
    packages = [line for line in lines if line and not line.startswith('#')]
    assert packages
    assert [line for line in packages if '#' not in line] == []


def test_a_login_shell_within_the_environment_finds_the_programs(folder):
    """As tmux starts one: PATH is that of /etc/profile, other variables are those of setup.bash."""
    for name in ('ours', 'on_top', 'without_programs'):
        (folder / name / ('lib' if 'without' in name else 'bin')).mkdir(parents=True)
    result = subprocess.run(
        ['/bin/bash', '-c', 'source "$1"; PATH=/usr/bin; restore_path; restore_path; echo "$PATH"',
         'test', ROOT / 'angen'], capture_output=True, text=True,
        env={'CMAKE_PREFIX_PATH': f'{folder}/on_top:{folder}/ours:{folder}/without_programs'})
    assert result.stdout == f'/usr/bin:{folder}/on_top/bin:{folder}/ours/bin\n', result.stderr


def test_no_arguments_print_the_usage(folder):
    result = subprocess.run([ROOT / 'angen'], capture_output=True, text=True)
    assert result.returncode == 0
    assert './angen run' in result.stdout


@pytest.mark.parametrize('command', ['build', 'docs', 'package', 'run', 'shell', 'test', 'wheel'])
def test_help_of_a_command_builds_nothing(command):
    usage = subprocess.run([ROOT / 'angen', 'help'], capture_output=True, text=True)
    asked = subprocess.run([ROOT / 'angen', command, '--help'], capture_output=True, text=True)
    assert (asked.returncode, asked.stdout, asked.stderr) == (0, usage.stdout, '')


def test_both_helps_name_every_command():
    usage = subprocess.run([ROOT / 'angen', 'help'], capture_output=True, text=True)
    same = subprocess.run([ROOT / 'angen', '--help'], capture_output=True, text=True)
    assert usage.stdout == same.stdout and usage.returncode == 0
    commands = make_parser()._subparsers._group_actions[0].choices
    words = set(usage.stdout.split())
    assert set(commands) <= words, set(commands) - words


def test_a_suite_that_is_missing_is_named_in_one_line():
    result = subprocess.run([ROOT / 'angen', 'test', 'nope'], capture_output=True, text=True)
    assert_one_line(result, 'nope', 'pytest')


def test_nothing_waits_for_another_that_builds_nothing(tmp_path):
    """A command of a finished build does not even take the lock."""
    with (ROOT / 'build/angen/lock').open('w') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        result = subprocess.run([ROOT / 'angen', 'shell', '-c', 'true'],
                                capture_output=True, text=True, timeout=60)
    assert (result.returncode, result.stderr) == (0, '')


def test_no_message_is_generated_for_lisp():
    """Each would take a process of its own in the first build."""
    commands = (ROOT / 'build/build.ninja').read_text()
    assert 'gen_cpp.py' in commands and 'gen_lisp.py' not in commands


def test_the_catalog_has_no_plug_ins_of_the_tests():
    result = subprocess.run([ROOT / 'angen', 'plugins', '--json'], capture_output=True, text=True,
                            env=dict(os.environ, ANGEN_PLUGIN_PATH='', GAZEBO_PLUGIN_PATH=''))
    assert 'pir' in result.stdout
    assert 'tape_measure' not in result.stdout and 'turntable' not in result.stdout


def test_another_python_first_on_path_is_not_used(folder):
    program(folder / 'bin' / 'python3', f'touch {folder}/used; exit 1')
    environment = dict(os.environ, PATH=f'{folder}/bin:{os.environ["PATH"]}')
    command = 'python3 -c "import rospy, angen_msgs.msg, sys; print(sys.executable)"'
    result = subprocess.run([ROOT / 'angen', 'shell', '-c', command],
                            capture_output=True, text=True, env=environment)
    assert (result.returncode, result.stdout) == (0, '/usr/bin/python3\n'), result.stderr
    assert not (folder / 'used').exists()


def test_the_demo_hands_on_options_and_exit_code(tmp_path):
    result = subprocess.run([ROOT / 'angen', 'demo', '--route', tmp_path / 'none.yaml'],
                            capture_output=True, text=True, cwd=tmp_path)
    assert result.returncode == 1
    assert result.stderr.splitlines()[-1] == (
        f'angen: {tmp_path}/none.yaml: cannot be read: No such file or directory')


@pytest.fixture
def checkout():
    """A built checkout that the user of `prepare_in` may not write."""
    root = Path(tempfile.mkdtemp(prefix='angen_'))
    shutil.copy(ROOT / 'angen', root)
    for path in ROOT.glob('dependencies*.apt'):
        shutil.copy(path, root)
    (root / 'src').mkdir()
    (root / 'CMakeLists.txt').touch()
    (root / 'devel').mkdir()
    (root / 'devel/setup.bash').touch()
    (root / 'build/angen').mkdir(parents=True)
    for name in ('built-run', 'built-all'):
        (root / 'build/angen' / name).write_text(f'{root}\n')
    yield root
    set_modes(root, 0o755)
    shutil.rmtree(root)


def set_modes(root, mode):
    for path in (root, *root.rglob('*')):
        if path.is_dir():
            path.chmod(mode)


def prepare_in(root):
    """Runs what every command does first, as a user who is not root."""
    set_modes(root, 0o555)
    other_user = {'user': 65534, 'group': 65534, 'extra_groups': []} if os.getuid() == 0 else {}
    return subprocess.run(['/bin/bash', '-c', 'source "$1"; prepare run; echo ready', 'test',
                           root / 'angen'], capture_output=True, text=True, cwd='/', **other_user)


def test_a_checkout_of_another_user_works_when_it_is_built(checkout):
    result = prepare_in(checkout)  # its stamp of packages is older than the last apt-get
    assert (result.returncode, result.stdout, result.stderr) == (0, 'ready\n', '')


def test_a_checkout_of_another_user_that_has_changed_is_named(checkout):
    (checkout / 'src/new.cpp').touch()
    os.utime(checkout / 'build/angen/built-run', (0, 0))
    assert_one_line(prepare_in(checkout), f'{checkout} cannot be written', 'not built',
                    f'{checkout}/angen build')


def test_a_checkout_of_another_user_names_missing_packages(checkout):
    with (checkout / 'dependencies.apt').open('a') as file:
        file.write('no-such-package # for the test\n')
    assert_one_line(prepare_in(checkout), f'{checkout} cannot be written', 'no-such-package')


def test_a_checkout_of_another_user_without_a_build_is_named(checkout):
    shutil.rmtree(checkout / 'build')
    assert_one_line(prepare_in(checkout), f'{checkout} cannot be written', 'not built')


def run_coverage(folder, *arguments):
    """The suites of ./angen coverage, in a built checkout where commands only print."""
    (folder / 'build-coverage/devel').mkdir(parents=True)
    (folder / 'build-coverage/devel/setup.bash').touch()
    script = '''
    source "$1/angen"; source "$1/.ci/checks.bash"; root=$2
    install() { :; }; prepare() { :; }; locked() { :; }; report() { :; }
    suite() { echo "$@"; [[ $1 != pytest ]] || echo "${pytest_arguments[@]}"; }
    run_coverage "${@:3}"'''
    return subprocess.run(['bash', '-c', script, 'test', ROOT, folder, *arguments],
                          capture_output=True, text=True)


def test_coverage_has_a_floor_for_each_language(tmp_path):
    printed = run_coverage(tmp_path, '--floor', '81', '72').stdout.splitlines()
    assert '--fail-under-line 81' in next(line for line in printed if line.startswith('gcovr'))
    assert any('--cov-fail-under=72' in line for line in printed)


@pytest.mark.parametrize('words', [['--floor'], ['--floor', '80'], ['--floor', '80', 'x'], ['80']])
def test_a_floor_is_two_numbers(tmp_path, words):
    assert_one_line(run_coverage(tmp_path, *words), '--floor CPP PYTHON')
