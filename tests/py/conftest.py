"""Worlds for the tests of `import angen`; none of them needs ROS."""
from typing import Callable

import pytest

import angen
from sdf_text import WORLDS, sdf_world


@pytest.fixture(scope='session')
def building() -> str:
    """The path of the whole building."""
    return str(WORLDS / 'angen.world')


@pytest.fixture
def world() -> Callable[..., angen.World]:
    """Makes a world from the text of its models."""
    def make(content: str, plugins: str = '', seed: int = 0) -> angen.World:
        return angen.World.from_text(sdf_world(content, plugins), seed=seed)
    return make
