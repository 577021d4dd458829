"""angen task seek: the processes of --seeds, with searches that take no time; its route."""
import signal
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Iterator

import pytest
from angen_apps.robot.entities import Entity
from angen_apps.robot.route_file import Route, default_route, read_route
from angen_apps.seek import command
from angen_apps.seek.run import Figures

LIMIT = 600  # s of wall time, many times what it takes
ROBOT = Entity('drive', 'turtlebot', 'turtlebot', (0, 0, 0, 0, 0, 0, 1))
LIFT = Entity('elevator', 'elevator', 'elevator', (0, 0, 0, 0, 0, 0, 1))


def search(world: Path, route: Route, home: str, seed: int, ambient: bool, *_: Any
           ) -> SimpleNamespace:
    return SimpleNamespace(figures=Figures(seed, ambient, True, 5.0 + seed, 'hall0', 1.0, 2.0, 0.01,
                                           'hall0', 3.0, 0, 0.1))


def survey(*_: Any) -> tuple[str, None, Path]:
    return 'home', None, Path('a.world')


@pytest.fixture
def ends() -> Iterator[None]:
    """The test fails where it takes longer than LIMIT."""
    def too_long(*_: Any) -> None:
        raise AssertionError(f'not within {LIMIT} s')

    before = signal.signal(signal.SIGALRM, too_long)
    signal.alarm(LIMIT)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def test_many_seeds_end_every_time(ends: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                   capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(command, 'survey', survey)
    monkeypatch.setattr(command.run, 'search', search)
    monkeypatch.setattr(command, 'draw_times', lambda *_: None)
    monkeypatch.setattr(command.gc, 'collect', lambda: 0)  # 0.1 s a search, for modules of tests
    for _ in range(5):
        assert command.seek_seeds(None, None, range(1, 13), 600.0, tmp_path, json=False) == 0
        rows = (tmp_path / 'seek.csv').read_text().splitlines()[1:]
        assert [row.split(',')[:2] for row in rows] == [
            [str(seed), ambient] for seed in range(1, 13) for ambient in ('True', 'False')]
    assert 'wrote' in capsys.readouterr().out


def test_a_building_without_an_elevator_is_searched_without_one() -> None:
    route = read_route(default_route())
    assert command.served(route, [ROBOT, LIFT]) == route
    assert command.served(route, [ROBOT]) == replace(route, elevator=None)


def test_the_elevator_of_a_route_of_ones_own_has_to_be_there() -> None:
    route = replace(read_route(default_route()), path=default_route().with_name('mine.yaml'))
    assert command.served(route, [ROBOT]) == route
