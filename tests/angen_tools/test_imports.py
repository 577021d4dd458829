"""The order of the modules: no import cycle, also not through imports inside of functions."""
from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[2] / 'src/angen_tools/src/angen_tools'
TESTS = Path(__file__).resolve().parent
Graph = dict[str, set[str]]


def imports(source: str, modules: set[str]) -> set[str]:
    """The modules of angen_tools that a module imports, anywhere in it."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, 'relative import'
            base = node.module or ''
            found |= {name if (name := f'{base}.{alias.name}') in modules else base
                      for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return {name.removeprefix('angen_tools.') for name in found if name in modules}


def module_graph(folder: Path) -> Graph:
    """What each module imports, as `world.sdf`."""
    names = {path: '.'.join(path.relative_to(folder).with_suffix('').parts)
             for path in folder.rglob('*.py') if path.name != '__init__.py'}
    modules = {f'angen_tools.{name}' for name in names.values()}
    return {name: imports(path.read_text(encoding='utf-8'), modules)
            for path, name in names.items()}


def package_graph(modules: Graph) -> Graph:
    """What each sub-package imports of others."""
    graph: Graph = {}
    for name, imported in modules.items():
        package = name.split('.')[0]
        graph.setdefault(package, set()).update(
            other.split('.')[0] for other in imported if other.split('.')[0] != package)
    return graph


def cycle(graph: Graph) -> list[str]:
    """A cycle, empty where there is none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_no_module_imports_itself_through_others() -> None:
    graph = module_graph(SOURCES)
    assert len(graph) > 40 and any(graph.values())
    assert cycle(graph) == []


def test_no_subpackage_imports_itself_through_others() -> None:
    graph = package_graph(module_graph(SOURCES))
    assert graph['common'] == set()
    assert 'cli' not in set().union(*graph.values())
    assert cycle(graph) == []


def test_a_cycle_is_found_also_inside_of_functions(tmp_path: Path) -> None:
    for name, text in {'a/x.py': 'from angen_tools.b import y',
                       'b/y.py': 'def f():\n    from angen_tools.a.x import g'}.items():
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text(text)
    graph = module_graph(tmp_path)
    assert graph == {'a.x': {'b.y'}, 'b.y': {'a.x'}}
    assert cycle(graph) and cycle(package_graph(graph))


@pytest.mark.parametrize('test', sorted(TESTS.rglob('*/test_*.py')), ids=lambda path: path.stem)
def test_each_test_file_is_named_after_a_module(test: Path) -> None:
    source = SOURCES / test.parent.name / f'{test.stem.removeprefix("test_")}.py'
    assert source.exists() or test.stem == 'test_docs', f'{test} tests no module of that name'
