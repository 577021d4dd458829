#!/usr/bin/env python3
"""Packs an installation as a wheel for people without ROS: the module angen, the angen command,
its applications, models and worlds, and the libraries that they need.

    .ci/wheel.py PREFIX FOLDER [MODULE ...]

writes FOLDER/angen-VERSION-….whl and prints its name. Each MODULE is the module angen for a
further version of Python.
"""
import base64
import hashlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Sequence

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ('angen_models', 'angen_tools', 'angen_apps')
ROS = re.compile(r'lib(roscpp|rosconsole|python3)')  # libraries of the node need one of these
# What each Linux has, by PEP 600.
SYSTEM = re.compile(r'(ld-linux|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|z)\.so)')
FILES = ('share/angen_sim/worlds', 'share/angen_apps/config', 'share/angen_apps/page',
         'lib/angen_sim/angen_mesh')
# Names on PyPI of Debian's packages in dependencies.apt; those of ROS and of MQTT are not needed
# without ROS. Arrays of NumPy 2 differ from those that Debian's pybind11 reads.
PYPI = {'numpy': 'numpy<2; python_version<"3.12"', 'lxml': 'lxml', 'argcomplete': 'argcomplete',
        'rich': 'rich', 'psutil': 'psutil', 'matplotlib': 'matplotlib', 'scipy': 'scipy',
        'shapely': 'shapely', 'yaml': 'pyyaml', 'pil': 'pillow', 'aiohttp': 'aiohttp',
        'qrcode': 'qrcode'}

ABOUT = """# Angen

A simulator of smart apartments: doors, elevators, lamps and people move; motion, light, door,
contact and many other sensors measure them. This package needs no ROS: `import angen`, and
the command `angen` with generate, plan, home, import, world, run --fast, care, realism,
validate and web --replay.

    angen world home --seed 3 -o home.world
    angen plan home.world -o plan.png
    angen generate --days 1 --seed 3 --out data
"""


def version() -> str:
    text = (ROOT / 'src/angen_sim/package.xml').read_text()
    return re.search(r'<version>(.*)</version>', text)[1]  # type: ignore[index]


def output(*command: str | Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def needed(file: Path) -> list[str]:
    """The libraries that a file names, without those of these."""
    return output('patchelf', '--print-needed', file).split()


def own_libraries(folder: Path) -> list[Path]:
    """The libraries and plug-ins that need no ROS, without second names: a wheel has no links."""
    files = {path.name: path for path in folder.glob('lib*.so') if not path.is_symlink()}

    def of_ros(name: str) -> bool:
        return bool(ROS.match(name)) or name in files and any(map(of_ros, needed(files[name])))
    return [path for name, path in sorted(files.items()) if not of_ros(name)]


def copy_files(prefix: Path, modules: list[Path], to: Path) -> None:
    """All but the libraries of others."""
    python = prefix / 'lib/python3/dist-packages'
    for module in modules:
        shutil.copy2(module, to)
    for name in (*PACKAGES, 'angen-stubs'):
        shutil.copytree(python / name, to / name, ignore=shutil.ignore_patterns('__pycache__'))
    bundle = to / 'angen_files'
    for name in FILES:
        (bundle / name).parent.mkdir(parents=True, exist_ok=True)
        if (prefix / name).is_dir():
            shutil.copytree(prefix / name, bundle / name)
        else:
            shutil.copy2(prefix / name, bundle / name)
    for library in own_libraries(prefix / 'lib'):
        shutil.copy2(library, bundle / 'lib')
        if library.with_suffix('.json').exists():
            shutil.copy2(library.with_suffix('.json'), bundle / 'lib')


def bundle_libraries(to: Path, build: Path) -> list[Path]:
    """Copies the libraries of others that the files need; these name folders beside them only.
    Returns where the libraries were."""
    folder = to / 'angen_files/lib'
    ours = [*to.glob('*.so'), *folder.glob('lib*.so'), folder / 'angen_sim/angen_mesh']
    own = {path.name for path in folder.iterdir()}
    found: dict[str, Path] = {}
    for file in ours:
        for line in subprocess.run(['ldd', file], capture_output=True, text=True, check=True,
                                   env={'LD_LIBRARY_PATH': str(build)}).stdout.splitlines():
            name, arrow, place = line.strip().partition(' => ')
            if not arrow or name in own or SYSTEM.match(name):
                continue
            if place == 'not found':
                raise SystemExit(f'{file}: its library {name} is not found')
            found[name] = Path(place.split()[0])
    for name, library in found.items():
        shutil.copy2(library.resolve(), folder / name)
        (folder / name).chmod(0o644)
    for file in (*ours, *(folder / name for name in found)):
        deep = len(file.relative_to(to).parts)
        path = {1: '$ORIGIN/angen_files/lib', 4: '$ORIGIN/..'}.get(deep, '$ORIGIN')
        subprocess.run(['strip', '--strip-unneeded', file], check=True)
        subprocess.run(['patchelf', '--set-rpath', path, file], check=True)
    return sorted(found.values())


def licenses(libraries: list[Path], to: Path) -> None:
    """Ours, and those of the libraries of others."""
    to.mkdir(parents=True)
    shutil.copy2(ROOT / 'LICENSE', to)
    for library in libraries:
        owner = ''
        for place in (library.resolve(), Path('/usr') / str(library.resolve()).lstrip('/'),
                      Path(str(library.resolve()).removeprefix('/usr'))):
            found = subprocess.run(['dpkg', '-S', place], capture_output=True, text=True)
            owner = owner or found.stdout.partition(':')[0]
        text = Path('/usr/share/doc') / owner / 'copyright'
        if owner and text.exists():
            shutil.copy2(text, to / f'{owner}.txt')


def tags(modules: list[Path]) -> list[str]:
    """The versions of Python that modules are for, such as cp311, ascending."""
    found = (re.search(r'\.cpython-(3)(\d+)-', module.name) for module in modules)
    return [f'cp3{minor}' for minor in sorted(int(each[2]) for each in found if each)]


def platform_tag() -> str:
    """The Linux of this machine, as PEP 600 has it."""
    glibc = platform.libc_ver()[1].replace('.', '_')
    return f'manylinux_{glibc}_{platform.machine()}'


def metadata(pythons: list[str]) -> str:
    listed = re.findall(r'^python3-(\S+)', (ROOT / 'dependencies.apt').read_text(), re.MULTILINE)
    requires = ''.join(f'Requires-Dist: {PYPI[name]}\n' for name in listed if name in PYPI)
    if pythons[0] != pythons[-1]:
        requires += 'Requires-Dist: numpy; python_version>="3.12"\n'
    first, after = (int(python[3:]) for python in (pythons[0], pythons[-1]))
    return (f'Metadata-Version: 2.1\nName: angen\nVersion: {version()}\n'
            'Summary: A simulator of smart apartments with robots, people and sensors\n'
            f'License: Apache-2.0\nRequires-Python: >=3.{first},<3.{after + 1}\n{requires}'
            'Description-Content-Type: text/markdown\n\n' + ABOUT)


def write(tree: Path, file: Path) -> None:
    """A wheel of the files of a folder: the same files give the same bytes."""
    info = f'angen-{version()}.dist-info'
    record = []
    with zipfile.ZipFile(file, 'w', zipfile.ZIP_DEFLATED) as wheel:
        files = [each for each in tree.rglob('*') if each.is_file()]
        # A catalog (.json) is read if it is newer than its library: it is unpacked later.
        for path in sorted(files, key=lambda each: (each.suffix == '.json', each)):
            name, content = str(path.relative_to(tree)), path.read_bytes()
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100755 if path.stat().st_mode & 0o100 else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=')
            record.append(f'{name},sha256={digest.decode()},{len(content)}\n')
        entry = zipfile.ZipInfo(f'{info}/RECORD', (1980, 1, 1, 0, 0, 0))
        wheel.writestr(entry, ''.join(record) + f'{info}/RECORD,,\n')


def pack(prefix: Path, folder: Path, further: Sequence[Path] = ()) -> Path:
    """The wheel of an installation, and of the module for further versions of Python."""
    modules = [*prefix.glob('lib/python3/dist-packages/angen.*.so'), *further]
    pythons = tags(modules)
    with tempfile.TemporaryDirectory() as made:
        tree = Path(made)
        copy_files(prefix, modules, tree)
        info = tree / f'angen-{version()}.dist-info'
        licenses(bundle_libraries(tree, prefix / 'lib'), info / 'licenses')
        (info / 'METADATA').write_text(metadata(pythons))
        lines = ''.join(f'Tag: {each}-{each}-{platform_tag()}\n' for each in pythons)
        (info / 'WHEEL').write_text('Wheel-Version: 1.0\nGenerator: angen\n'
                                    f'Root-Is-Purelib: false\n{lines}')
        scripts = tree / f'angen-{version()}.data/scripts'
        scripts.mkdir(parents=True)
        text = (ROOT / 'src/angen_tools/scripts/angen').read_text()
        (scripts / 'angen').write_text(text.replace('#!/usr/bin/env python3', '#!python'))
        (scripts / 'angen').chmod(0o755)
        folder.mkdir(parents=True, exist_ok=True)
        versions = '.'.join(pythons)
        wheel = folder / f'angen-{version()}-{versions}-{versions}-{platform_tag()}.whl'
        write(tree, wheel)
    return wheel


if __name__ == '__main__':
    if len(sys.argv) < 3:
        raise SystemExit(__doc__)
    print(pack(Path(sys.argv[1]), Path(sys.argv[2]), [Path(each) for each in sys.argv[3:]]))
