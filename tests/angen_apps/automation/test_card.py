"""The card of a plan: entities of the bridge, at their places in the picture."""
from pathlib import Path

import angen
import pytest
import yaml
from PIL import Image

from angen_apps.automation.card import write
from angen_apps.plan.draw import draw
from angen_apps.plan.overlays import What

ROOT = Path(__file__).resolve().parents[3]


def test_lamps_are_where_they_hang(tmp_path: Path) -> None:
    """Two lamps of a floor give the scale; a third is where that says, and one upstairs as far
    right as the floors are apart. The picture has the tint of a kitchen beside its lamp."""
    world = ROOT / 'worlds/angen.world'
    draw(world, tmp_path / 'plan.png', What(),
         lambda axes: write(tmp_path / 'card.yaml', world, axes, 'plan.png'))
    card = yaml.safe_load((tmp_path / 'card.yaml').read_text())
    assert (card['type'], card['image']) == ('picture-elements', '/local/plan.png')
    at = {each['entity']: [float(each['style'][key].rstrip('%')) for key in ('left', 'top')]
          for each in card['elements']}
    assert len(at) == len(card['elements']) > 100
    kinds = {each['entity']: each['type'] for each in card['elements']}
    assert kinds['sensor.kitchen_light_sensor'] == 'state-label'
    assert kinds['sensor.entrance_rfid_reader'] == kinds['light.kitchen_lamp'] == 'state-icon'
    poses = {name: pose for _, name, _, pose in angen.World(str(world)).entities('lamp')}
    (x0, y0), (x1, y1) = (poses[name][:2] for name in ('kitchen0', 'workroom0'))
    (a0, b0), (a1, b1) = at['light.kitchen_lamp'], at['light.work_room_lamp']
    x, y = poses['bathroom0'][:2]
    assert at['light.bathroom_lamp'] == pytest.approx(
        [a0 + (x - x0) * (a1 - a0) / (x1 - x0), b0 + (y - y0) * (b1 - b0) / (y1 - y0)], abs=0.02)
    assert b1 < b0 and y1 > y0  # from the top
    up, = (at[name] for name in at if name == 'light.upstairs_kitchen_lamp')
    assert up[0] > 50.0 and up[1] == pytest.approx(b0, abs=0.02)
    picture = Image.open(tmp_path / 'plan.png').convert('RGB')
    red, green, blue = picture.getpixel((round(a0 / 100 * picture.width) + 12,
                                         round(b0 / 100 * picture.height) - 40))
    assert (red, green, blue) == (0xfd, 0xf0, 0xd8)  # of a kitchen
