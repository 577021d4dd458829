"""An installation works without the sources and the build: models, worlds, tools, plug-ins."""
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / 'tests/examples'
# An empty folder over the sources and the build; the rest of the words is a command.
HIDE = ['unshare', '--map-root-user', '--mount', 'sh', '-c',
        f'mount -t tmpfs none {shlex.quote(str(ROOT))} && exec "$@"', 'hide']


@pytest.fixture(scope='module')
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What `cmake --install` has installed, or what stands in the folder $ANGEN_INSTALLED."""
    if 'ANGEN_INSTALLED' in os.environ:
        return Path(os.environ['ANGEN_INSTALLED'])
    folder = tmp_path_factory.mktemp('installed')
    subprocess.run(['cmake', '--install', ROOT / 'build'], check=True, stdout=subprocess.DEVNULL,
                   env=dict(os.environ, DESTDIR=str(folder)))
    cache = (ROOT / 'build/CMakeCache.txt').read_text()
    found = re.search(r'^CMAKE_INSTALL_PREFIX:\w+=/(.*)$', cache, re.MULTILINE)
    assert found
    return folder / found.group(1)


def installed(prefix: Path, command: str) -> str:
    """The output of a command that has only the installation, in a folder that it may fill; without
    the sources where this machine lets a user hide them."""
    may_hide = subprocess.run([*HIDE, 'true'], capture_output=True).returncode == 0
    folder = prefix.parent / 'out'
    folder.mkdir(exist_ok=True)
    result = subprocess.run(
        [*(HIDE if may_hide else []), 'bash', '-c', f'source "$0/setup.bash" && {command}', prefix],
        cwd=folder, capture_output=True, text=True,
        env={'HOME': str(folder), 'PATH': '/usr/bin:/bin', 'LC_ALL': 'C.UTF-8'})
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_files_are_installed_and_no_links_to_sources(prefix: Path) -> None:
    share = prefix / 'share/angen_sim'
    assert (share / 'launch/angen.launch').is_file() and (share / 'worlds/angen.world').is_file()
    assert (prefix / 'include/angen/plugin/register.h').is_file()
    links = [path for path in prefix.rglob('*') if path.is_symlink()]
    assert links and all('/' not in os.readlink(path) and path.exists() for path in links)
    texts = [path for kind in ('cmake', 'pc', 'launch', 'py') for path in prefix.rglob(f'*.{kind}')]
    assert [path for path in texts if str(ROOT / 'src') in path.read_text()] == []


def test_nothing_lies_among_the_headers_of_ros(prefix: Path) -> None:
    ours = {path.name for package in ('angen_sim', 'angen_gazebo')
            for path in (ROOT / 'src' / package).iterdir()}
    assert not ours & {path.name for path in (prefix / 'include').iterdir()}


WORLD = '$0/share/angen_sim/worlds/angen.world'


@pytest.mark.parametrize('command, output', [
    ('angen --version', r'angen \d+\.\d+\.\d+\n'),
    ('angen plugins', r'\bdoor\b.*\bpir\b'),
    ('angen check model://kitchen_door', r'no errors'),
    (f'angen check {WORLD}', r'no errors'),
    (f'angen run --fast {WORLD} --for 1', r'^1 s'),
    (f'angen home {WORLD}', r'kitchen'),
    (f'angen plan {WORLD} -o plan.png', r'14 rooms'),
    ('angen map --floor 0 -o map', r'map'),
    ('angen world apartment --pir 2 -o flat.world && angen check flat.world', r'no errors'),
    ('angen bench --help && angen care --help && angen web --help', r'sensors'),
    ('cd $(rospack find angen_apps) && ls page/index.html config', r'care.yaml'),
    ('roslaunch --nodes angen_sim angen.launch', r'/map_publisher\n'),
    ('roslaunch --nodes gazebo_ros empty_world.launch', r'/gazebo\n'),
    (f'python3 -c "import angen; print(len(angen.World(\'{WORLD}\').home))"', r'\d'),
])
def test_first_things(prefix: Path, command: str, output: str) -> None:
    assert re.search(output, installed(prefix, command), re.DOTALL)


def test_a_package_with_a_plugin(prefix: Path) -> None:
    source = prefix.parent / 'tape_measure'
    shutil.copytree(EXAMPLES / 'tape_measure', source)
    installed(prefix, f'cmake -S {source} -B built -DPYTHON_EXECUTABLE=/usr/bin/python3 >&2 && '
                      'cmake --build built >&2')
    listed = installed(prefix, 'source built/devel/setup.bash && angen plugins && '
                               f'angen check {source}/tape_measure.sdf')
    assert 'tape' in listed


def test_without_angen_gazebo(prefix: Path) -> None:
    """What is missing is said in one line; worlds of ours need none of it."""
    for library in ('import', 'gazebo'):
        (prefix / f'lib/libangen_{library}.so').unlink()
    assert re.search(r'no errors', installed(prefix, f'angen check {WORLD}'))
    foreign = '<sdf version="1.6"><world name="w"/></sdf>'
    said = installed(prefix, f"echo '{foreign}' > w.world; ! angen check w.world 2>&1")
    assert re.fullmatch(r'(angen: )?\S*w\.world:1: <world name="w"> is read as made for Gazebo, by '
                        r'the package angen_gazebo: libangen_import\.so is not found on the '
                        r'plug-in path; build that package, or source its workspace\n', said)
