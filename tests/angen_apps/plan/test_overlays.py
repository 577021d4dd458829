"""Files that are drawn over a plan: events, and tracks as tasks and generated data have them."""
import gzip
import itertools
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from matplotlib.text import Annotation, Text

from angen_apps.plan import overlays
from angen_apps.plan.apartment import apartment
from angen_apps.plan.draw import draw, read_scene, sheet
from angen_apps.plan.writer import write_world
from angen_tools.common.failure import Failure
from angen_tools.common.files import pyplot
from angen_tools.world.models import building

ENTITIES = [('pir', 'hall_pir0_a', 'hall_pir0_a', (0.0,) * 7)]


def of(path: Path) -> dict[str, np.ndarray]:
    return overlays.read(overlays.What(track=path), ENTITIES).tracks


def test_tracks_of_a_task_and_of_residents(tmp_path: Path) -> None:
    task = tmp_path / 'track.csv'
    task.write_text('time_s,x_m,y_m,z_m,yaw_rad,believed_x_m\n0.2,1.5,-2,0,0,9\n0.4,1.6,-2,4,0,9\n')
    (track,) = of(task).values()
    assert track[:, :3] == pytest.approx(np.array([(1.5, -2, 0), (1.6, -2, 4)]))
    data = tmp_path / 'track.csv.gz'
    with gzip.open(data, 'wt') as file:
        file.write('time,resident,x,y,storey\n0,anna,1,2,0\n1,bert,3,4,1\n')
    assert {name: list(rows[0, [0, 1, 3]]) for name, rows in of(data).items()} == {
        'anna': [1, 2, 0], 'bert': [3, 4, 1]}


@pytest.mark.parametrize('name, text, what', [
    ('t.csv', 'a,b\n1,2\n', 't.csv:1: has no column x'),
    ('t.csv', 'x,y\n1,2\n1,b\n', 't.csv:3: x and y must be numbers'),
    ('t.csv', 'x,y\n1,inf\n', 't.csv:2: x and y must be finite'),
    ('t.csv.gz', 'x,y\n1,2\n', 't.csv.gz: cannot be read'), ('t.csv', '', 'has no column x')])
def test_wrong_tracks(name: str, text: str, what: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(Failure, match=what.replace('.', r'\.')):
        of(tmp_path / name)


def test_a_storey_shows_its_own_events_and_tracks(tmp_path: Path) -> None:
    """The picture changes where a sensor fires, and nowhere else."""
    write_world(apartment(1, 1, 3), tmp_path / 'home.world', 'seed')
    (tmp_path / 'events.csv').write_text('time,source\n1,hall_pir0_a\n2,hall_pir0_a\n')

    def picture(what: overlays.What) -> np.ndarray:
        draw(tmp_path / 'home.world', tmp_path / 'plan.png', what)
        return np.asarray(imread(tmp_path / 'plan.png'))

    plain = picture(overlays.What())
    assert np.array_equal(plain, picture(overlays.What()))
    changed = (plain != picture(overlays.What(events=tmp_path / 'events.csv'))).any(axis=2)
    assert 0.001 < changed.mean() < 0.1


def test_names_of_sensors_can_be_read(tmp_path: Path) -> None:
    scene = read_scene(building())
    with pyplot().rc_context({'font.size': 8}):
        figure, axes = sheet(scene, scene.drawn())
        for axis, storey in axes:
            overlays.draw(axis, scene, storey, overlays.Data(), overlays.What(sensors=True))
            figure.canvas.draw()
            names = [text for text in axis.texts if isinstance(text, Annotation)]
            assert len(names) > 4 and all(text.get_fontsize() >= 6 for text in names)
            boxes = [Text.get_window_extent(text) for text in axis.texts]
            assert not [1 for a, b in itertools.combinations(boxes, 2) if a.overlaps(b)]


def test_an_hour_in_which_only_people_came_has_no_events_to_show(tmp_path: Path) -> None:
    path = tmp_path / 'events.csv'
    path.write_text('time,source,kind,event\n0,anna,world,spawned\n')
    assert not overlays.read(overlays.What(events=path), []).counts
    path.write_text('time,source,kind,event\n0,anna,pir,motion\n')
    with pytest.raises(Failure, match='names no sensor'):
        overlays.read(overlays.What(events=path), [])
