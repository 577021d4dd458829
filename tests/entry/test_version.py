"""One version: package.xml of angen_sim has it, and everything else agrees."""
from pathlib import Path
import re
import subprocess

import pytest

import angen

ROOT = Path(__file__).resolve().parents[2]


def version_of(package: Path) -> str:
    return re.search(r'<version>(.*)</version>', package.read_text()).group(1)


VERSION = version_of(ROOT / 'src/angen_sim/package.xml')


def test_it_is_a_semantic_version():
    assert re.fullmatch(r'\d+\.\d+\.\d+', VERSION)


@pytest.mark.parametrize('package', sorted([*(ROOT / 'src').glob('*/package.xml'),
                                            *(ROOT / 'ros2').glob('*/package.xml')]),
                         ids=lambda path: '/'.join(path.parts[-3:-1]))
def test_every_package_has_it(package):
    assert version_of(package) == VERSION


@pytest.mark.parametrize('command', [[ROOT / 'angen'], ['angen']], ids=['entry', 'command'])
def test_the_command_prints_it(command):
    result = subprocess.run([*command, '--version'], capture_output=True, text=True)
    assert (result.returncode, result.stdout) == (0, f'angen {VERSION}\n')


def test_the_module_has_it():
    assert angen.__version__ == VERSION


def test_the_debian_package_has_it():
    assert (ROOT / 'debian/changelog').read_text().startswith(f'angen ({VERSION}) ')
