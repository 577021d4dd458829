"""The first run of the shell entry: packages first, then the build; its output; one more try."""
import os
from pathlib import Path
import shutil
import subprocess

import pytest

ROOT = Path(__file__).resolve().parents[2]
# They note when they begin and end; apt-get and cmake take long enough to overlap with others.
FAKES = {
    'dpkg-query': 'cat installed 2>/dev/null',
    'dpkg': 'true',
    'sudo': 'exec "$@"',
    'apt-get': '''
case " $* " in *" install "*) ;; *) exit 0 ;; esac
echo "apt-get begins" >>order
for package; do echo "installed $package" >>installed; done
for percent in 0 50 100; do echo "pmstatus:rviz:$percent.0:Unpacking rviz" >&3; sleep 0.2; done
echo "apt-get ends" >>order
fails apt-get''',
    'cmake': '''
echo "cmake begins" >>order; sleep 0.5; echo "cmake ends" >>order
fails cmake && while [ $# -gt 0 ]; do [ "$1" != -B ] || touch "$2/build.ninja"; shift; done''',
    'ninja': '''
case " $* " in *" -t "*) for i in 1 2 3; do echo "g++ -c $i.cpp"; done; exit 0 ;; esac
echo "ninja begins" >>order; cat output 2>/dev/null; echo "ninja ends" >>order
fails ninja''',
}
# The file fails-NAME has as many lines as calls of NAME are to fail.
HEAD = '''#!/bin/bash
cd "{folder}"
fails() {{ [ -s "fails-$1" ] || return 0; sed -i 1d "fails-$1"; return 1; }}
'''


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """A folder with a checkout, and programs that install and build nothing."""
    (tmp_path / 'bin').mkdir()
    for name, text in FAKES.items():
        (tmp_path / 'bin' / name).write_text(HEAD.format(folder=tmp_path) + text + '\n')
        (tmp_path / 'bin' / name).chmod(0o755)
    checkout = tmp_path / 'checkout'
    (checkout / 'src').mkdir(parents=True)
    (checkout / 'tests').mkdir()
    (checkout / 'devel').mkdir()
    (checkout / 'devel/setup.bash').touch()
    (checkout / 'CMakeLists.txt').touch()
    shutil.copy(ROOT / 'angen', checkout)
    for path in ROOT.glob('dependencies*.apt'):
        shutil.copy(path, checkout)
    return tmp_path


def prepare(machine: Path, level: str = 'run') -> subprocess.CompletedProcess[str]:
    """The first steps of every command; the real /usr/sbin is left alone."""
    return subprocess.run(
        ['/bin/bash', '-c', 'source "$1"; PATH=$2:$PATH; '
         'install_script=${install_script//\\/usr\\/sbin/$2}; prepare "$3"; echo ready',
         'test', machine / 'checkout/angen', machine / 'bin', level],
        capture_output=True, text=True, env=dict(os.environ, CMAKE_PREFIX_PATH=''))


def order(machine: Path) -> list[str]:
    return (machine / 'order').read_text().splitlines()


def fail(machine: Path, program: str, times: int = 1) -> None:
    (machine / f'fails-{program}').write_text('once\n' * times)


ALL = [f'{program} {word}' for program in ('apt-get', 'cmake', 'ninja')
       for word in ('begins', 'ends')]


@pytest.mark.parametrize('level, lists', [('run', ['']), ('all', ['']), ('test', ['', '-test'])])
def test_nothing_is_built_while_packages_are_installed(
        machine: Path, level: str, lists: list[str]) -> None:
    result = prepare(machine, level)
    assert (result.returncode, result.stdout) == (0, 'ready\n'), result.stderr
    assert order(machine) == ALL
    installed = set((machine / 'installed').read_text().splitlines())
    for name in lists:
        lines = (ROOT / f'dependencies{name}.apt').read_text().splitlines()
        listed = {line.split()[0] for line in lines if line and not line.startswith('#')}
        assert listed and {f'installed {package}' for package in listed} <= installed


def test_more_packages_are_installed_before_more_is_built(machine: Path) -> None:
    prepare(machine)
    (machine / 'order').unlink()
    assert prepare(machine, 'test').returncode == 0
    assert order(machine) == [*ALL[:2], *ALL[4:]]


@pytest.mark.parametrize('program, step', [
    ('apt-get', 'installing'), ('cmake', 'configuring'), ('ninja', 'building')])
def test_a_first_run_is_tried_once_more(machine: Path, program: str, step: str) -> None:
    fail(machine, program)
    result = prepare(machine)
    assert (result.returncode, result.stdout) == (0, 'ready\n'), result.stderr
    assert f'angen: {step} failed; it is tried once more' in result.stderr
    assert order(machine).count(f'{program} begins') == 2


@pytest.mark.parametrize('program, step', [
    ('apt-get', 'installing'), ('cmake', 'configuring'), ('ninja', 'building')])
def test_what_fails_twice_is_named(machine: Path, program: str, step: str) -> None:
    fail(machine, program, 3)
    result = prepare(machine)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.splitlines()[-1].startswith(f'angen: {step} failed; all of it is in ')
    assert order(machine)[-1] == f'{program} ends'
    assert order(machine).count(f'{program} begins') == 2


def build_again(machine: Path, output: str) -> subprocess.CompletedProcess[str]:
    """A build that fails once, of a source that was edited."""
    prepare(machine)
    (machine / 'order').unlink()
    (machine / 'checkout/src/edited.cpp').touch()
    fail(machine, 'ninja')
    (machine / 'output').write_text(output)
    return prepare(machine)


def test_an_error_in_an_edited_source_is_reported_at_once(machine: Path) -> None:
    result = build_again(machine, 'edited.cpp:1:1: error: expected unqualified-id\n')
    assert result.returncode == 1 and 'once more' not in result.stderr
    assert 'edited.cpp:1:1' in result.stderr
    assert order(machine) == ['ninja begins', 'ninja ends']


def test_a_compiler_without_memory_is_given_another_try(machine: Path) -> None:
    result = build_again(machine, 'c++: fatal error: Killed signal terminated program cc1plus\n')
    assert result.returncode == 0, result.stderr
    assert order(machine) == 2 * ['ninja begins', 'ninja ends']


def test_progress_counts_sources_and_other_commands(machine: Path) -> None:
    """Two messages and three sources, which take the most of the time."""
    (machine / 'output').write_text(
        'ninja: Entering directory\n1 5 Generating a\n2 5 Generating b\n'
        '3 5 Building CXX object a.o\n4 5 Building CXX object b.o\n5 5 Building CXX object c.o\n')
    result = prepare(machine)
    assert [line for line in result.stderr.splitlines() if '%' in line] == [
        'angen: installing 0 %', 'angen: installing 50 %', 'angen: installing 100 %',
        'angen: building 0 %', 'angen: building 34 %', 'angen: building 67 %',
        'angen: building 100 %']


@pytest.mark.parametrize('seconds, done, text', [
    (4, 50, ''), (10, 0, ''), (10, 50, ', 10 s left'), (30, 25, ', 2 min left'),
    (60, 10, ', 9 min left'), (60, 100, ', 0 s left')])
def test_the_time_left_is_computed_from_the_progress(seconds: int, done: int, text: str) -> None:
    result = subprocess.run(
        ['/bin/bash', '-c', 'source "$1"; time_left "$2" "$3" 100; echo "$left"', 'test',
         ROOT / 'angen', str(seconds), str(done)], capture_output=True, text=True)
    assert result.stdout == f'{text}\n'
