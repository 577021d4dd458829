"""The wheel, and the Debian packages: what they list, contain and need."""
import base64
import csv
import hashlib
import importlib.util
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(  # type: ignore[index]
    r'<version>(.*)</version>', (ROOT / 'src/angen_sim/package.xml').read_text())[1]


def packer() -> Any:
    spec = importlib.util.spec_from_file_location('wheel', ROOT / '.ci/wheel.py')
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope='module')
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of what is built."""
    folder = tmp_path_factory.mktemp('wheel')
    for package in ('angen_models', 'angen_sim', 'angen_tools', 'angen_apps'):
        subprocess.run(['cmake', '-P', ROOT / f'build/src/{package}/cmake_install.cmake'],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       env=dict(os.environ, DESTDIR=str(folder / 'root')))
    prefix = re.search(r'^CMAKE_INSTALL_PREFIX:\w+=/(.*)$',
                       (ROOT / 'build/CMakeCache.txt').read_text(), re.MULTILINE)
    assert prefix
    return packer().pack(folder / 'root' / prefix[1], folder)  # type: ignore[no-any-return]


def test_the_wheel_has_what_its_record_says(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as file:
        record = file.read(f'angen-{VERSION}.dist-info/RECORD').decode()
        rows = list(csv.reader(record.splitlines()))
        assert sorted(row[0] for row in rows) == sorted(file.namelist())
        for name, digest, size in rows[:-1]:
            content = file.read(name)
            made = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode()
            assert (digest, size) == ('sha256=' + made.rstrip('='), str(len(content)))


def test_the_wheel_is_for_this_python_and_has_no_ros(wheel: Path) -> None:
    assert re.fullmatch(rf'angen-{VERSION}-cp3\d+-cp3\d+-manylinux_2_\d+_\w+\.whl', wheel.name)
    with zipfile.ZipFile(wheel) as file:
        names = file.namelist()
        metadata = file.read(f'angen-{VERSION}.dist-info/METADATA').decode()
    for part in ('angen-stubs/__init__.pyi', 'angen_tools/py.typed', 'angen_files/lib/libode.so.8',
                 'angen_files/lib/libdoor_world_plugin.so', 'angen_files/lib/angen_sim/angen_mesh',
                 'angen_files/share/angen_sim/worlds/angen.world',
                 'angen_files/share/angen_apps/config/care.yaml',
                 'angen_files/share/angen_apps/page/index.html',
                 'angen_files/lib/libangen_scene.so',
                 f'angen-{VERSION}.data/scripts/angen'):
        assert part in names
    assert not [name for name in names if re.search(r'ros(cpp|console)|libpython|libc\.so', name)]
    assert f'Version: {VERSION}' in metadata
    for name in ('numpy', 'aiohttp', 'qrcode'):
        assert f'Requires-Dist: {name}' in metadata


def test_a_wheel_for_several_pythons_names_each_and_its_numpy() -> None:
    modules = [Path(f'angen.cpython-{version}-x86_64-linux-gnu.so') for version in (313, 311, 312)]
    pythons = packer().tags(modules)
    assert pythons == ['cp311', 'cp312', 'cp313']
    metadata = packer().metadata(pythons)
    assert 'Requires-Python: >=3.11,<3.14' in metadata
    assert 'Requires-Dist: numpy; python_version>="3.12"' in metadata


def test_the_unpacked_wheel_runs_alone(wheel: Path, tmp_path: Path) -> None:
    """Its libraries are found beside it, and none of this checkout."""
    with zipfile.ZipFile(wheel) as file:
        file.extractall(tmp_path)
    mesh = tmp_path / 'angen_files/lib/angen_sim/angen_mesh'
    mesh.chmod(0o755)  # as pip does
    program = ('import angen; w = angen.World("angen_files/share/angen_sim/worlds/'
               'angen.world"); w.run(1); print(w.fingerprint, angen.__file__);'
               f'print(sum("{ROOT}" in line for line in open("/proc/self/maps")))')
    said = subprocess.run([sys.executable, '-c', program], cwd=tmp_path, text=True, check=True,
                          capture_output=True,
                          env={'PATH': '/usr/bin', 'HOME': str(tmp_path)}).stdout.split()
    import angen
    here = angen.World(str(ROOT / 'worlds/angen.world'))
    here.run(1)
    assert said[0] == here.fingerprint and said[1].startswith(str(tmp_path)) and said[2] == '0'


# --- Debian

def listed(file: str) -> set[str]:
    return set(re.findall(r'^([a-z0-9][a-z0-9.+-]+)', (ROOT / file).read_text(), re.MULTILINE))


def debian() -> dict[str, str]:
    """The paragraphs of debian/control by name; '' is the source."""
    parts = (ROOT / 'debian/control').read_text().split('\n\n')
    return {'': parts[0], **{part.split()[1]: part for part in parts[1:]}}


# Of dependencies.apt, but not of a package: what the entry of a checkout is for.
OF_A_CHECKOUT = {'catkin-tools', 'make', 'g++', 'libbenchmark-dev'}
# And the reverse.
OF_PACKAGES = {'debhelper-compat', 'dh-python', 'python3-genpy'}


def test_the_packages_need_what_a_checkout_needs() -> None:
    control = (ROOT / 'debian/control').read_text()
    fields = re.findall(r'^(?:Build-Depends|Depends|Recommends):(.*(?:\n .*)*)', control, re.M)
    needed = {entry.split()[0] for field in fields for entry in field.split(',') if entry.strip()}
    named = {name for name in needed if not name.startswith('$')} - set(debian())
    assert listed('dependencies.apt') - OF_A_CHECKOUT == named - OF_PACKAGES


def test_each_package_lists_its_files() -> None:
    assert {path.stem for path in (ROOT / 'debian').glob('*.install')} == set(debian()) - {''}


def test_each_message_package_is_in_ros_angen_msgs() -> None:
    """Its files are found by the end of their names."""
    folders = [*(ROOT / 'src').glob('*/msg'), *(ROOT / 'src').glob('*/srv')]
    assert folders and all(folder.parent.name.endswith('_msgs') for folder in folders)


def test_each_ros_library_is_loaded_by_the_node_only() -> None:
    """The modules with roscpp, by the build, are those of the package angen."""
    rules = (ROOT / 'debian/rules').read_text()
    named = re.search(r'^OF_ROS = (.*)$', rules, re.MULTILINE)
    assert named
    libraries = [path for path in (ROOT / 'devel/lib').glob('lib*.so') if not path.is_symlink()]
    needs = {path.name: subprocess.run(['readelf', '-d', path], capture_output=True, text=True,
                                       check=True).stdout for path in libraries}
    of_ros = {name[3:-3] for name, text in needs.items() if 'libroscpp.so' in text}
    assert set(named[1].split()) == of_ros
