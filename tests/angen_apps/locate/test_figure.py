"""The picture of located tags: discs and crosses on the plan, on the storey where they are."""
from math import nan
from pathlib import Path

import pytest

from angen_apps.locate import figure
from angen_apps.locate.belief import Answer
from angen_apps.locate.score import Row
from angen_apps.plan.apartment import apartment
from angen_apps.plan.draw import Scene, read_scene
from angen_apps.plan.writer import write_world
from angen_tools.common.files import pyplot

UNKNOWN = (nan, nan, nan)


@pytest.fixture(scope='module')
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    path = tmp_path_factory.mktemp('locate') / 'home.world'
    write_world(apartment(1, 2, 3), path, 'none')
    return read_scene(path)


def rows(*answers: tuple[str, tuple[float, float, float]]) -> list[Row]:
    """An answer every 2 s about a tag that is in the kitchen at 1, 1."""
    return [Row(2.0 * i, Answer('anna', room, 0.9, at), 'kitchen0', (1.0, 1.0, 0.0))
            for i, (room, at) in enumerate(answers)]


def test_a_disc_says_how_long_and_a_cross_where_the_room_is_wrong() -> None:
    right, wrong = ('kitchen0', (1.0, 2.0, 0.0)), ('hall0', (3.0, 2.0, 0.0))
    given = rows(right, right, right, wrong)
    made, axis = pyplot().subplots()
    figure._located(axis, given, 'anna', 'red', figure._every(given))
    assert [text.get_text() for text in axis.texts] == ['6 s']
    sizes = {tuple(disc.get_offsets()[0]): disc.get_sizes()[0] for disc in axis.collections[1:3]}
    assert sizes == {(1.0, 2.0): 6 * figure.DISC, (3.0, 2.0): 2 * figure.DISC}
    crosses = axis.collections[3].get_offsets()
    assert crosses.tolist() == [[3.0, 2.0]]
    pyplot().close(made)


def test_only_storeys_with_a_tag_are_drawn(scene: Scene, tmp_path: Path,
                                           monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[list[int]] = []
    sheet = figure.sheet
    monkeypatch.setattr(figure, 'sheet', lambda scene, storeys: drawn.append(
        [storey.number for storey in storeys]) or sheet(scene, storeys))
    upper = scene.home.elevation(1)
    for at in (UNKNOWN, (1.0, 1.0, upper)):
        figure.draw(tmp_path / 'locate.png', rows(('kitchen1', at)), scene)
    assert drawn == [[0], [0, 1]]
    assert (tmp_path / 'locate.png').read_bytes().startswith(b'\x89PNG')
