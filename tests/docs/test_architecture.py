"""Claims of docs/architecture.md about the code: who uses what, and who names what."""
import re
from pathlib import Path

import pytest

from tests.docs.pages import REFERENCE, ROOT

PAGE = (ROOT / 'docs/architecture.md').read_text()
SIM = ROOT / 'src/angen_sim'
GAZEBO = ROOT / 'src/angen_gazebo'
APPS = ROOT / 'src/angen_apps/src/angen_apps'

# Names of kinds that are words of mechanics, light, SDF or homes as well.
ORDINARY = {'battery', 'camera', 'contact', 'depth', 'door', 'drive', 'elevator', 'force', 'lamp',
            'plug', 'receiver', 'switch', 'tag', 'temperature', 'window'}

# header: the modules whose sources may include it
LIBRARIES = {'tinyxml2.h': {'document', 'assets'}, 'ode/': {'physics'},
             'embree3/': {'rays', 'render'}, 'assimp/': {'assets'}, 'png.h': {'assets'},
             'jpeglib.h': {'assets'}, 'sdf/sdf': {'import'},
             'ros/': {'ros', 'tf', 'rviz', 'gazebo', 'node'}}

# a sentence of the page, with the figure that a constant in the code has
FIGURES = [
    (r'cells of (\S+) m', 'sim/mover_index.cpp', r'kCell = (\S+);'),
    (r'left a margin of (\S+) m', 'sim/mover_index.cpp', r'kSlack = (\S+);'),
    (r'have not moved for (\d+) ticks are settled', 'sim/instance.cpp', r'kUnmoved = (\S+);'),
    (r'sleep after (\S+) s', 'physics/sleep.cpp', r'kIdleTime = (\S+);'),
    (r'threads of subscribers \((\d+)\)', 'node/node.cpp', r'kSubscriberThreads = (\d+)'),
    (r'threads of services \((\d+)\)', 'node/services.cpp', r'kServiceThreads = (\d+)'),
    (r'at most (\d+) wait for calls', 'node/services.cpp', r'kMaxSteps = (\d+)'),
]


def folder(module: str) -> Path:
    return next(package / module for package in (SIM, GAZEBO) if (package / module).is_dir())


def sources(module: str) -> list[Path]:
    return [path for path in folder(module).rglob('*') if path.suffix in ('.h', '.cpp')]


def code(path: Path) -> str:
    """The text of a source without its comments."""
    return re.sub(r'//[^\n]*', '', path.read_text())


def test_modules_use_what_the_page_says() -> None:
    said = re.findall(r'^- `(\w+)` → ((?:\w+(?:, | and | for )?)+)', PAGE.replace('\n  ', ' '),
                      re.M)
    assert len(said) > 15
    for module, names in said:
        given = (folder(module) / 'CMakeLists.txt').read_text()
        if 'angen_module' not in given:
            continue  # plug-ins
        used = re.search(r'USES ([a-z ]+)', given)
        assert used, module
        wanted = set(re.findall(r'\w+', names.split(' for ')[0])) - {'and'}
        assert wanted <= set(used.group(1).split()), module


@pytest.mark.parametrize('header', LIBRARIES)
def test_libraries_have_one_user(header: str) -> None:
    modules = [module.name for package in (SIM, GAZEBO) for module in package.iterdir()
               if module.is_dir()]
    users = {module for module in modules for path in sources(module)
             if f'#include <{header}' in path.read_text()}
    assert users and users <= LIBRARIES[header]


def test_the_engines_name_no_kind() -> None:
    kinds = {page.stem for page in REFERENCE.glob('*.md')}
    assert {'person', 'pir'} | ORDINARY <= kinds
    for module in ('sim', 'physics', 'rays', 'light', 'render'):
        for path in sources(module):
            text = code(path)
            assert not kinds & set(re.findall(r'kind\w*(?:\(\))? [!=]= "(\w+)"', text)), path
            words = {word.lower() for word in re.findall(r'[a-z]+|[A-Z][a-z]+', text)}
            assert not words & (kinds - ORDINARY), path


def test_no_header_spreads_the_view() -> None:
    spreads = {str(path.relative_to(SIM)) for path in SIM.rglob('*.h')
               if '#include "plugin/view.h"' in path.read_text()}
    assert spreads == {'plugin/register.h', 'sim/view.h'}
    assert not [path for path in SIM.rglob('*.h') if '#include "sim/view.h"' in path.read_text()]


def test_packages_import_packages_above_them() -> None:
    table = PAGE.split('## Packages of angen_apps')[1].split('\n## ')[0]
    order = [name for row in re.findall(r'^\| (`.*?) \|', table, re.M)
             for name in re.findall(r'`(\w+)`', row)]
    assert sorted(order) == sorted(path.parent.name for path in APPS.glob('*/__init__.py'))
    for package in order:
        for path in (APPS / package).rglob('*.py'):
            for used in re.findall(r'^\s*(?:from|import) angen_apps\.(\w+)', path.read_text(),
                                   re.M):
                known = used not in order or order.index(used) <= order.index(package)
                assert known, f'{path} imports {used}'


@pytest.mark.parametrize(('sentence', 'source', 'constant'), FIGURES)
def test_figures_are_those_of_the_code(sentence: str, source: str, constant: str) -> None:
    said = re.search(sentence, PAGE.replace('\n  ', ' '))
    real = re.search(constant, (SIM / source).read_text())
    assert said and real
    assert float(said.group(1)) == float(real.group(1))


def test_a_message_of_a_pir_has_fields_of_its_kind() -> None:
    message = (ROOT / 'src/angen_msgs/msg/PirMsg.msg').read_text()
    fields = re.findall(r'^(?:bool|float64) (\w+)', message, re.M)
    kind = (SIM / 'sensors/pir/pir.cpp').read_text()
    assert len(fields) == 6
    assert all(f'"{field}"' in kind for field in fields)


def test_nothing_links_to_angen_gazebo_or_asks_for_its_dialect_by_name() -> None:
    """Only the interface of document/ and the names of libraries are known."""
    modules = {path.name for path in GAZEBO.iterdir() if path.is_dir()} - {'cmake'}
    assert modules == {'import', 'robots', 'gazebo'}
    for path in SIM.rglob('*.*'):
        if path.suffix in ('.h', '.cpp'):
            used = re.findall(r'#include "(\w+)/', path.read_text())
            assert not modules & set(used), path
        if path.name == 'CMakeLists.txt':
            assert not modules & set(re.findall(r'\w+', path.read_text().split('USES')[-1])), path
    for module in ('sim', 'sdf', 'physics', 'tf'):
        assert not [path for path in sources(module) if 'tolerant' in path.read_text()]
