"""The floors of things on the plan and in 3D."""
import dataclasses
import json
from pathlib import Path

import angen
import page_node
from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import world_of
from angen_apps.web.scene import packed
from angen_apps.web.server import json_text
from angen_tools.session.in_process import InProcess
from angen_tools.world import sdf


def test_things_are_on_the_floor_of_their_room(tmp_path: Path) -> None:
    path = tmp_path / 'home.world'
    path.write_text(sdf.text(world_of(apartment(2, 2, 55), 'home')[0]))
    world = angen.World(str(path))
    home = InProcess(world).home
    (tmp_path / 'state.json').write_text(json_text(
        {'home': dataclasses.asdict(home), 'scene': packed(world.scene)}))
    found = json.loads(page_node.run(tmp_path, 'home.mjs', tmp_path / 'state.json'))
    floors = {thing.name: home.room(thing.room).storey for thing in home.things if thing.room}
    assert {name: (one['plan'], set(one['parts'])) for name, one in found.items()} == {
        name: (floor, {floor}) for name, floor in floors.items() if name in found}
    upper = [name for name, floor in floors.items() if floor == 1 and name in found]
    assert any('sofa' in name for name in upper) and len(upper) > 5
