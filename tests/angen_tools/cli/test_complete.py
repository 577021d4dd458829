"""Completions that a shell offers after TAB."""
from pathlib import Path
from types import SimpleNamespace

import pytest

from angen_tools.cli import complete
from angen_tools.common.failure import Failure
from angen_tools.session import live

ENTITIES = [SimpleNamespace(name=name, kind=kind) for name, kind in (
    ('table0', 'model'), ('kitchen0', 'door'), ('hall0', 'door'), ('eye', 'pir'))]


class Running:
    """A simulator with the entities above."""

    def __init__(self, limit: float) -> None:
        pass

    def entities(self) -> list[SimpleNamespace]:
        return ENTITIES


class Absent(Running):
    """No simulator."""

    def entities(self) -> list[SimpleNamespace]:
        raise Failure('nothing runs')


@pytest.fixture
def running(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live, 'Live', Running)


def test_names_are_those_that_the_command_takes(running: None) -> None:
    assert complete.names_of('door', 'pir')() == ['kitchen0', 'hall0', 'eye']
    assert complete.names_of_devices('door')() == ['kitchen0', 'hall0', 'all']
    assert complete.names_of_devices('heater')() == []
    assert complete.names_to_watch() == ['kitchen0', 'hall0', 'eye']
    assert complete.names_to_delete() == ['table0', 'eye']


def test_without_a_simulator_there_are_kinds_but_no_names(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live, 'Live', Absent)
    assert complete.names_to_watch() == [] and complete.names_of_devices('door')() == []
    assert {'model', 'pir', 'door'} <= set(complete.kind_names())


def test_sources_are_addresses_and_files(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'my.sdf').touch()
    assert 'model://chair' in complete.sources('model://ch')
    assert complete.sources(str(tmp_path / 'm')) == [str(tmp_path / 'my.sdf')]
