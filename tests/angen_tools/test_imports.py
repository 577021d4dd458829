"""The order of packages and modules: no import cycle, also not through imports inside of functions.

angen_bench imports angen_apps, both import angen_tools, which finds their commands by name, and all
import angen_models.
"""
import ast
import functools
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = {name: ROOT / f'src/{name}/src' for name in ('angen_models', 'angen_tools', 'angen_apps')}
SOURCES['angen_bench'] = ROOT / 'bench'
TESTS = {'angen_tools': ROOT / 'tests/angen_tools', 'angen_apps': ROOT / 'tests/angen_apps'}
FINDS_COMMANDS = 'angen_tools.cli.applications'  # the module that may name other packages
Graph = dict[str, set[str]]


def imports(source: str, modules: set[str]) -> set[str]:
    """The modules, of these, that a module imports anywhere in it."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, 'relative import'
            base = node.module or ''
            found |= {name if (name := f'{base}.{alias.name}') in modules else base
                      for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return found & modules


def files(sources: dict[str, Path]) -> dict[str, Path]:
    """The file of each module, by a name as `angen_tools.world.sdf`."""
    return {'.'.join(path.relative_to(folder).with_suffix('').parts): path
            for package, folder in sources.items() for path in (folder / package).rglob('*.py')
            if path.name != '__init__.py'}


def module_graph(sources: dict[str, Path]) -> Graph:
    """The imports of each module."""
    found = files(sources)
    return {name: imports(path.read_text(encoding='utf-8'), set(found))
            for name, path in found.items()}


@functools.cache
def our_graph() -> Graph:
    """The imports of each of our modules."""
    return module_graph(SOURCES)


def reduced(modules: Graph, depth: int) -> Graph:
    """The imports of each package from others; a package is the first `depth` words of a name."""
    graph: Graph = {}
    for name, imported in modules.items():
        package = '.'.join(name.split('.')[:depth])
        others = {'.'.join(other.split('.')[:depth]) for other in imported}
        graph.setdefault(package, set()).update(others - {package})
    return graph


def cycle(graph: Graph) -> list[str]:
    """A cycle, empty where there is none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_no_module_imports_itself_through_others() -> None:
    graph = our_graph()
    assert len(graph) > 40 and any(graph.values())
    assert cycle(graph) == []


def test_no_subpackage_imports_itself_through_others() -> None:
    graph = reduced(our_graph(), 2)
    assert graph['angen_tools.common'] == set()
    assert cycle(graph) == []


def test_only_commands_import_the_command_line() -> None:
    users = {name for name, imported in our_graph().items()
             if any(other.startswith('angen_tools.cli.') for other in imported)}
    assert {name.rpartition('.')[0] for name in users if name != 'angen_bench.commands'} \
        == {'angen_tools.cli', 'angen_apps.cli'}


def test_each_package_imports_only_those_below_it() -> None:
    assert reduced(our_graph(), 1) == {
        'angen_models': set(), 'angen_tools': {'angen_models'},
        'angen_apps': {'angen_models', 'angen_tools'},
        'angen_bench': {'angen_apps', 'angen_models', 'angen_tools'}}


@pytest.mark.parametrize('package', ['angen_apps', 'angen_bench'])
def test_angen_tools_names_packages_above_it_once(package: str) -> None:
    naming = {name for name, path in files({'angen_tools': SOURCES['angen_tools']}).items()
              if f'{package}.' in path.read_text(encoding='utf-8')}
    assert naming == {FINDS_COMMANDS}


def test_a_cycle_is_found_also_inside_of_functions(tmp_path: Path) -> None:
    for name, text in {'p/a/x.py': 'from p.b import y',
                       'p/b/y.py': 'def f():\n    from p.a.x import g'}.items():
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_text(text)
    graph = module_graph({'p': tmp_path})
    assert graph == {'p.a.x': {'p.b.y'}, 'p.b.y': {'p.a.x'}}
    assert cycle(graph) and cycle(reduced(graph, 2))


@pytest.mark.parametrize('test', sorted(
    path for tests in TESTS.values() for path in tests.rglob('*/test_*.py')),
    ids=lambda path: path.stem)
def test_each_test_file_is_named_after_a_module(test: Path) -> None:
    package = test.parent.parent.name
    source = SOURCES[package] / package / test.parent.name / \
        f'{test.stem.removeprefix("test_")}.py'
    named = source.exists() or source.with_suffix('').is_dir() or test.stem == 'test_docs'
    assert named, f'{test} tests no module of that name'


@pytest.mark.parametrize('test', sorted((ROOT / 'tests/bench').glob('test_*.py')),
                         ids=lambda path: path.stem)
def test_each_test_of_the_benches_is_named_after_a_module(test: Path) -> None:
    assert (ROOT / f'bench/angen_bench/{test.stem.removeprefix("test_")}.py').exists()
