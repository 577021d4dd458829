"""The types of the module: angen.pyi, inspect.signature, and what mypy says of a program."""
import importlib.util
import inspect
import subprocess
import sys
from pathlib import Path
from typing import Any

import angen
import pytest

PY = Path(__file__).resolve().parents[2] / 'src/angen_sim/py'
GOOD = '''
import angen
with angen.World('a.world', seed=3) as world:
    world.run(1.5)
    for time, source, kind, event, detail in world.events():
        print(time + 1.0, source.upper())
    print(world.room_at(0, 1, 2).upper(), world.sensor('pir', 'a')['ranges'])
'''


def make_stub() -> Any:
    spec = importlib.util.spec_from_file_location('make_stub', PY / 'make_stub.py')
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_stub_is_that_of_the_module() -> None:
    assert (PY / 'angen.pyi').read_text() == make_stub().text(), \
        'in ./angen shell, run python3 src/angen_sim/py/make_stub.py'


def errors_of(program: str, folder: Path) -> str:
    """What mypy says of a program, with numpy unread, which takes it ten seconds."""
    (folder / 'program.py').write_text(program)
    return subprocess.run(
        [sys.executable, '-m', 'mypy', '--follow-imports=skip', '--cache-dir', folder / 'cache',
         '--check-untyped-defs', PY / 'angen.pyi', folder / 'program.py'],
        capture_output=True, text=True).stdout


def test_mypy_accepts_a_program(tmp_path: Path) -> None:
    assert 'Success' in errors_of(GOOD, tmp_path)


@pytest.mark.parametrize('right, wrong, error', [
    ('seed=3', "seed='3'", '[arg-type]'),
    ('world.run(1.5)', 'world.walk(1.5)', '[attr-defined]'),
    ('time + 1.0', "time + 'a'", '[operator]'),
    ('room_at(0, 1, 2)', 'room_at(0, 1)', '[call-arg]'),
])
def test_mypy_finds_an_error(right: str, wrong: str, error: str, tmp_path: Path) -> None:
    said = errors_of(GOOD.replace(right, wrong), tmp_path)
    assert error in said and 'Found 1 error' in said


def test_inspect_shows_the_parameters() -> None:
    signature = inspect.signature(angen.World.run)
    assert list(signature.parameters) == ['self', 'seconds', 'long_steps', 'until_event']
    assert signature.parameters['long_steps'].default is False
    assert list(inspect.signature(angen.World).parameters) == [
        'path', 'seed', 'record', 'allow_paths', 'memory_limit']
    assert list(inspect.signature(angen.World.from_text).parameters)[0] == 'text'
    assert inspect.signature(angen.Params.number).parameters['min'].default == float('-inf')
    assert 'Advances by simulated seconds' in (angen.World.run.__doc__ or '')


def functions(scope: Any) -> list[Any]:
    return [value for name, value in vars(scope).items()
            if callable(value) and not isinstance(value, type) and name[0] != '_']


@pytest.mark.parametrize('scope', [
    angen, *(value for value in vars(angen).values() if isinstance(value, type))])
def test_all_parameters_have_names(scope: Any) -> None:
    for function in functions(scope):
        assert 'arg0' not in inspect.signature(function).parameters
