"""angen web --video: frames at even times, and what it says where it cannot be made."""
import argparse
import dataclasses
import itertools
import subprocess
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from angen_apps.cli.web import size, speed, start
from angen_apps.web.film import Film, begin_of, shoot
from angen_apps.web.played import Lined
from angen_tools.common.failure import Failure

PAGE = Path(__file__).resolve().parents[3] / 'src/angen_apps/page'
NONE = np.zeros(0, np.uint32)
POSE = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
SIZE = 480, 320
KINDS = {'person': {'kind': 'person', 'role': 'device', 'doc': '', 'verbs': [], 'values': [],
                    'fields': [], 'models': []}}
HOME = {'storeys': [{'number': 0, 'name': '', 'elevation': 0.0, 'height': 2.7}], 'doors': [],
        'things': [], 'elevators': [], 'start': '2026-03-21T06:00:00',
        'rooms': [{'name': 'hall', 'use': 'hall', 'storey': 0, 'holes': [], 'floor': 0.0,
                   'ceiling': 2.7, 'area': 48.0, 'guessed': False,
                   'polygon': [[-6, -2], [6, -2], [6, 2], [-6, 2]]}]}
SCENE = {'revision': 1, 'meshes': [], 'lights': [], 'sensors': [], 'shapes': [
    {'type': 0, 'link': 0, 'mesh': 0, 'pose': POSE, 'color': [1, 0, 0, 1],
     'size': [0.4, 0.4, 1.7]}],
    'links': [{'model': 'anna', 'name': 'body', 'group': '', 'moves': True, 'pose': POSE}]}


class Walk(Lined):
    """One who walks from x = -4 to 4 in 8 s, of which the recording has positions at uneven
    times."""

    def __init__(self) -> None:
        super().__init__(8.0, 'walk')
        self.store.put('home', HOME)
        self.store.put_scene(SCENE, 1)
        self.store.put('entities', [{'kind': 'person', 'name': 'anna', 'model': 'anna',
                                     'topic': '', 'type': '', 'room': '', 'pose': POSE}])
        for time in (0.0, 0.3, 1.7, 2.0, 4.4, 4.5, 4.6, 7.1, 8.0):
            pose = np.array([time - 4.0, *POSE[1:]], np.float32)
            self.store.put_changes(1, np.array([0], np.uint32), pose, NONE,
                                   NONE.astype(np.float32), time)
        self._finish()


def film(path: Path, **more: Any) -> Film:
    return dataclasses.replace(Film(path, 1.0, 1.0, 5.0, SIZE, 'plan'), **more)


def frames(path: Path) -> list[Any]:
    """Its pictures as arrays."""
    raw = subprocess.run(['ffmpeg', '-loglevel', 'error', '-i', str(path),
                          '-fps_mode', 'passthrough', '-f', 'rawvideo',
                          '-pix_fmt', 'rgb24', '-'], check=True, stdout=subprocess.PIPE).stdout
    return list(np.frombuffer(raw, np.uint8).reshape(-1, SIZE[1], SIZE[0], 3).astype(int))


def place(picture: Any) -> float:
    """Where the person's mark is: the only thing of its green."""
    red, green, blue = (picture[60:240, :, i] for i in range(3))  # above the time line
    columns = np.nonzero((green - red > 60) & (blue - red > 60))[1]
    assert len(columns) > 20
    return float(columns.mean())


def test_motion_is_even(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / 'walk.mp4'
    shoot(Walk(), film(path), PAGE, KINDS)
    assert '1.0 s from 1.0 s on, 5 times as fast, 480 x 320' in capsys.readouterr().out
    pictures = frames(path)
    assert len(pictures) == 25
    at = [place(picture) for picture in pictures]
    steps = [b - a for a, b in itertools.pairwise(at)]
    assert 24 * np.mean(steps) > 100  # 4.8 m of 12
    assert max(steps) - min(steps) < 2.5  # px; a mark is drawn at whole ones
    assert [*tmp_path.iterdir()] == [path]


@pytest.mark.parametrize('view, name, count', [('3d', 'a.webm', 5), ('plan', 'a.gif', 2)])
def test_other_views_and_formats(tmp_path: Path, view: str, name: str, count: int) -> None:
    path = tmp_path / name
    shoot(Walk(), film(path, view=view, seconds=0.2), PAGE, KINDS)
    pictures = frames(path)
    assert len(pictures) == count
    assert np.abs(pictures[0] - pictures[-1]).max() > 50  # one walks
    assert len(np.unique(pictures[0].reshape(-1, 3), axis=0)) > 20


def test_a_film_is_as_long_as_its_recording(tmp_path: Path) -> None:
    path = tmp_path / 'a.gif'
    shoot(Walk(), film(path, start='06:00:07', speed=2.0), PAGE, KINDS)
    with Image.open(BytesIO(path.read_bytes())) as picture:
        assert picture.n_frames == 5  # the last second
    with pytest.raises(Failure, match='the recording ends at 8.0 s'):
        shoot(Walk(), film(path, start=9.0), PAGE, KINDS)


def test_what_fails_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('angen_apps.web.film.ENCODERS', {'gif': ['-c:v', 'no such encoder']})
    with pytest.raises(Failure, match='^ffmpeg: .*no such encoder'):
        shoot(Walk(), film(tmp_path / 'a.gif'), PAGE, KINDS)
    assert not [*tmp_path.iterdir()]


def test_what_is_missing_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    film(tmp_path / 'a.MP4').check()
    with pytest.raises(Failure, match=r'must end with \.mp4, \.webm, \.gif'):
        film(tmp_path / 'a.avi').check()
    with pytest.raises(Failure, match='its folder cannot be written'):
        film(tmp_path / 'no' / 'a.mp4').check()
    with pytest.raises(Failure, match='/proc: cannot be written'):
        film(Path('/proc/a.mp4')).check()
    (tmp_path / 'b.mp4').mkdir()
    with pytest.raises(Failure, match='is a folder'):
        film(tmp_path / 'b.mp4').check()
    monkeypatch.setenv('PATH', str(tmp_path))
    with pytest.raises(Failure) as failure:
        film(tmp_path / 'a.mp4').check()
    assert str(failure.value) == ('--video needs chromium and ffmpeg: '
                                  'sudo apt install chromium ffmpeg')


def test_where_it_begins() -> None:
    line, home = {'begin': 50.0}, {'start': '2026-03-21T06:00:00'}
    assert [begin_of(film(Path('a.gif'), start=given), line, home)
            for given in (None, 7.5, '06:01', '5:59')] == [50.0, 7.5, 60.0, 86340.0]
    assert begin_of(film(Path('a.gif'), start='0:10'), {}, {}) == 600.0


def test_options() -> None:
    assert (size('1280x720'), speed('20'), start('90'), start('1h'), start('7:30')) == (
        (1280, 720), 20.0, 90.0, 3600.0, '7:30')
    for option, text in ((size, '1281x720'), (size, '100x100'), (size, '1280'), (size, '9999x720'),
                         (speed, '0'), (speed, '-1'), (start, '25:00'), (start, '-5')):
        with pytest.raises((ValueError, argparse.ArgumentTypeError)):
            option(text)
