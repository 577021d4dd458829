"""The picture of warnings: each rule where it looks, on the plan of the home."""
from pathlib import Path

import pytest
from matplotlib.colors import to_hex
from matplotlib.image import imread

from angen_apps.care.figure import ASIDE, FAINT, WARNED, _draw_marks, draw
from angen_apps.care.offline import Watched
from angen_apps.care.rules_file import read_rules
from angen_apps.plan.apartment import apartment
from angen_apps.plan.draw import Scene, read_scene, sheet
from angen_apps.plan.writer import write_world
from angen_tools.common.files import pyplot

RULES = '''
signals:
  lamp on: {of: lamp/*, in: kitchen, is: on}
  motion: {of: pir/*, in: kitchen, is: motion}
rules:
  - {name: dark, reason: It is dark., when: [{not: lamp on, for: 1 min}]}
  - {name: seen, reason: Someone is here., when: [motion]}
  - {name: seen_long, reason: Someone is here., when: [{is: motion, for: 1 h}]}
  - {name: night, reason: It is night., when: [{time: 0:00 to 0:01}]}
'''


@pytest.fixture(scope='module')
def home(tmp_path_factory: pytest.TempPathFactory) -> tuple[Watched, Scene]:
    folder = tmp_path_factory.mktemp('care')
    write_world(apartment(1, 2, 3), folder / 'home.world', 'seed')
    (folder / 'rules.yaml').write_text(RULES)
    watched = Watched(read_rules(folder / 'rules.yaml'), folder / 'home.world', 1)
    watched.run(120.0, [])
    return watched, read_scene(folder / 'home.world')


def test_each_rule_is_marked_where_it_looks(home: tuple[Watched, Scene]) -> None:
    watched, scene = home
    figure, axes = sheet(scene, scene.drawn())
    before = [len(axis.texts) for axis, _ in axes]
    _draw_marks(axes, watched.engine, scene, {'dark'})
    lower, upper = ([(text.get_text(), *text.get_position()) for text in axis.texts[count:]]
                    for (axis, _), count in zip(axes, before))
    lamp, pir = (scene.pose_of(watched.engine.places[name]) for name in ('dark', 'seen'))
    assert lamp and pir and upper == []  # a rule of the time of day is at no place
    assert lower == [('1', *lamp[:2]), ('2', *pir[:2]), ('3', pir[0] + ASIDE, pir[1])]
    colors = [to_hex(patch.get_facecolor()) for patch in axes[0][0].patches[-3:]]
    assert colors == [WARNED, FAINT, FAINT]
    pyplot().close(figure)


def test_the_picture_is_a_plan_with_the_day_below(home: tuple[Watched, Scene],
                                                  tmp_path: Path) -> None:
    watched, scene = home
    sizes = []
    for each in (scene, None):  # None: a world without rooms
        draw(watched.engine, each, tmp_path / 'care.png')
        sizes.append(imread(tmp_path / 'care.png').shape)
    assert sizes[1][0] < 0.5 * sizes[0][0]
