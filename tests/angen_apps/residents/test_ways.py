"""Ways of residents: why there is none in an imported home, and one out of the apartment."""
from __future__ import annotations

from pathlib import Path

import angen
import pytest

from angen_apps.data.site import apartment
from angen_apps.residents.figures import walker
from angen_bench.homes import examples
from angen_tools.cli import main as cli


@pytest.mark.parametrize('name, said', [
    ('2BedroomApartment', '''people have a way through 7 of 8 doors and to 6 of 7 rooms
remark: no way through bathroom0: bathroom_toilet0 leaves 0.40 m of 0.60 m; a real person turns \
sideways
remark: no way to bathroom0: there is none through bathroom0'''),
    ('2BedroomHouseWithBasement', '''people have a way through 9 of 11 doors and to 7 of 12 rooms
remark: no way through living_room_b_right1: living_room_sofa1 leaves 0.32 m of 0.60 m
remark: no way through room_b1: living_room_sofa1 is in the way
remark: no way to garage0: no elevator leads to its floor'''),
    ('4BedroomHouse', '''people have a way through 17 of 21 doors and to 9 of 10 rooms
remark: no way through living_room_c_left0: its leaf opens by 25 degrees only''')])
def test_an_import_says_where_people_have_no_way_and_why(
        name: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / 'home.xml').write_bytes(examples()[name])
    world = str(tmp_path / 'home.world')
    assert cli.run(['import', str(tmp_path / 'home.xml'), '-o', world, '--sensors', 'none']) == 0
    assert said in capsys.readouterr().out
    assert cli.run(['home', world, '--residents', '1']) == 0
    lines = [line.removeprefix('remark: ') for line in said.splitlines()]
    assert '\n'.join(f'angen: {line}' for line in lines) in capsys.readouterr().err


@pytest.mark.parametrize('speed', [0.9, 1.0, 1.1, 1.2, 1.3])
def test_a_leaf_is_pulled_where_its_swing_and_what_stands_there_leave_room(
        tmp_path: Path, speed: float) -> None:
    """The flaps of a shoe cabinet, which can move, stand at the best place beside the entrance."""
    apartment(tmp_path / 'home.world')
    world = angen.World(str(tmp_path / 'home.world'), seed=1)
    for kind, _, model, _ in world.entities():
        if kind in ('person', 'drive') and model in world.models:
            world.delete(model)
    world.spawn(walker('bert', speed, 'person'), 'bert', [6.148, 7.973, 0.0, 0.0, 0.0, 0.0])
    world.command('person', 'bert', 'GoTo -1.2 5')
    world.run(30.0)
    assert 'arrived' in [event for _, name, _, event, _ in world.events() if name == 'bert']
