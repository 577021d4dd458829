"""The catalog of kinds of sensors and devices, which the plug-ins describe; no simulator needed.

Beside each plug-in library libX.so is libX.json, written when it was built: read here without
loading the library, so that --help stays quick.
"""
import json
import mmap
import os
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, Iterator

from angen_tools.common.failure import Failure
from angen_tools.common.installed import libraries
from angen_tools.common.nearest import did_you_mean

Plugin = dict[str, Any]  # an entry of angen.plugins()
KEYS = ('library', 'kind', 'doc', 'role', 'rate', 'models', 'sensor_type', 'example', 'verbs',
        'values', 'fields', 'params')  # keys that are read here
# in the file of a library that registers a plug-in with class_loader
MARKS = (b'N12class_loader4impl10MetaObjectI', b'N5angen6PluginE')
SPEEDS = ['m/s', 'rad/s']  # the values of a robot that cmd_vel drives
SCRIPT = b'angen.register('  # in a file of Python that registers one
LOADER = 'libangen_plugin.so'  # contains these words as it searches for them


def angen_module() -> Any:
    """The module angen; Failure if it is not built or not on the path."""
    try:
        import angen
    except ImportError as error:
        raise Failure(f'the angen module is not found ({error}); use ./angen, or source '
                      'devel/setup.bash') from None
    return angen


@contextmanager
def simulator(where: str = '') -> Iterator[Any]:
    """The module angen; its errors become a Failure that begins with `where`."""
    angen = angen_module()
    try:
        yield angen
    except angen.Error as error:
        raise Failure(f'{where}{error}') from None


def directories() -> list[Path]:
    """The folders of plug-in libraries, in the order in which the simulator searches."""
    def entries(variable: str) -> list[Path]:
        return [Path(entry) for entry in os.environ.get(variable, '').split(':') if entry]
    found = [*entries('ANGEN_PLUGIN_PATH'), *entries('GAZEBO_PLUGIN_PATH'),
             *(workspace / 'lib' for workspace in entries('CMAKE_PREFIX_PATH'))]
    own = libraries()
    return list(dict.fromkeys([*found, *([own] if own else [])]))


@cache
def plugins() -> list[Plugin]:
    """Every kind of every plug-in on the path: the list that angen.plugins() returns.

    A library that does not load has an entry whose kind is '' and whose doc says why.
    """
    found: dict[str, list[Plugin]] = {}
    undescribed = set()
    for library in _libraries():
        if library.name in found or library.name in undescribed:
            continue
        described = _read(library)
        if described is not None:
            found[library.name] = described
        elif _registers_plugins(library):
            undescribed.add(library.name)
    if undescribed:
        found.update(_loaded(undescribed))
    return [plugin for name in sorted(found) for plugin in found[name]]


def _libraries() -> list[Path]:
    return [library for directory in directories()
            for library in (*sorted(directory.glob('lib*.so')), *sorted(directory.glob('*.py')))
            if library.is_file() and not _is_alias(library)]


def _is_alias(library: Path) -> bool:
    """Whether a file is a second name of a library beside it; libX.so of libX.so.1 is
    none.
    """
    target = library.resolve()
    return library.is_symlink() and target.suffix == '.so' \
        and target.parent == library.parent.resolve()


def _read(library: Path) -> list[Plugin] | None:
    """The contents of the JSON file of a library; None without one that fits the library."""
    file = library.with_suffix('.json')
    try:
        if file.stat().st_mtime < library.stat().st_mtime:
            return None
        described = json.loads(file.read_text(encoding='utf-8'))
    except (OSError, ValueError):
        return None
    fits = isinstance(described, list) and all(
        isinstance(plugin, dict) and plugin.keys() >= set(KEYS) for plugin in described)
    return described if fits else None


def _registers_plugins(library: Path) -> bool:
    """Whether a library has plug-ins, by the words in its file: loading it would run its code."""
    if library.name == LOADER:
        return False
    try:
        with library.open('rb') as file, \
                mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            marks = (SCRIPT,) if library.suffix == '.py' else MARKS
            return all(content.find(mark) >= 0 for mark in marks)
    except (OSError, ValueError):  # it cannot be read, or is empty
        return False


def _loaded(libraries: set[str]) -> dict[str, list[Plugin]]:
    """The plug-ins of libraries that have to be loaded for it."""
    try:
        every = angen_module().plugins()
    except Failure as failure:
        return {name: [_broken(name, str(failure))] for name in libraries}
    return {name: [plugin for plugin in every if plugin['library'] == name] for name in libraries}


def _broken(library: str, why: str) -> Plugin:
    texts = dict.fromkeys(('role', 'sensor_type', 'example', 'command_topic'), '')
    return {'library': library, 'kind': '', 'doc': why, 'rate': 0.0, 'on_demand': False, **texts,
            **{key: [] for key in ('models', 'verbs', 'values', 'fields', 'params')}}


def kinds(role: str = '') -> dict[str, Plugin]:
    """The kinds by name, or those of a role: sensor or device."""
    return dict(_kinds(role))


@cache
def _kinds(role: str) -> dict[str, Plugin]:
    found: dict[str, Plugin] = {}
    for plugin in plugins():
        if plugin['kind'] and role in ('', plugin['role']):
            found.setdefault(plugin['kind'], plugin)
    return found


def forget() -> None:
    """Has the libraries searched again."""
    plugins.cache_clear()
    _kinds.cache_clear()


def kind_of(name: str) -> Plugin:
    """A kind; Failure if there is none of that name."""
    known = kinds()
    if name not in known:
        raise Failure(f"there is no kind '{name}'; "
                      + did_you_mean(name, known, 'angen plugins'))
    return known[name]


def is_robot(kind: Plugin) -> bool:
    """Whether devices of a kind drive, so that navigation sends them."""
    return bool(kind['values'] == SPEEDS)


def parameters(kind: str) -> dict[str, dict[str, Any]]:
    """The parameters of a kind, by path."""
    return {param['path']: param for param in kind_of(kind)['params']}


def has_parameter(plugin: Plugin, path: str) -> bool:
    """Whether a kind reads the parameter at that path."""
    return any(param['path'] == path for param in plugin['params'])
