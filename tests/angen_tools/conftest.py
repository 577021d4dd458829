"""Fixtures of the tests of angen_tools."""
import os
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any, Callable

import angen
import pytest

from angen_tools.cli import main as cli

MODELS = Path(__file__).resolve().parents[2] / 'worlds/models'


@pytest.fixture(scope='session')
def models_folder() -> Path:
    """worlds/models."""
    return MODELS


@pytest.fixture
def command(capfd: pytest.CaptureFixture[str]) -> Callable[..., CompletedProcess[str]]:
    """The angen command in this process, whose start takes no time then; it leaves no variable."""
    def run(*words: Any) -> CompletedProcess[str]:
        given, before = [str(word) for word in words], dict(os.environ)
        try:
            code = cli.run(given)
        except SystemExit as end:
            code = int(str(end.code))
        finally:
            os.environ.clear()
            os.environ.update(before)
        return CompletedProcess(given, code, *capfd.readouterr())
    return run


@pytest.fixture
def world() -> angen.World:
    """An empty world."""
    return angen.World(str(MODELS.parent / 'empty.world'))


@pytest.fixture(scope='session')
def table() -> str:
    """The SDF of a table, with the collisions top and leg on the link body."""
    return '''<sdf version="1.6"><model name="table"><static>true</static><link name="body">
  <collision name="top"><geometry><box><size>1 1 0.1</size></box></geometry></collision>
  <collision name="leg"><pose>0 0 -0.4 0 0 0</pose><geometry><box><size>0.1 0.1 0.7</size></box>
  </geometry></collision></link></model></sdf>'''
