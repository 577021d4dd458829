"""The nine homes of Debian's package sweethome3d, and small homes with further features."""
import re
from math import hypot, pi
from pathlib import Path
from typing import Any

import angen
import pytest
from lxml import etree

from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan import writer
from angen_apps.plan.model import Opening, Plan
from angen_apps.plan.polygons import area
from angen_apps.plan.walls import boxes
from angen_apps.plan.writer import write_world
from angen_bench import homes
from angen_tools.common.failure import Failure

NAMES = ('1BedroomApartmentWithRoundWall', '2BedroomApartment', '2BedroomApartmentWithBowWindow',
         '2BedroomHouseWithBasement', '3BedroomApartment', '3BedroomHouseWithAttic',
         '3BedroomHouseWithMezzanine', '4BedroomHouse', 'Studio')
SASH = '<sash xAxis="0.05" yAxis="0.5" width="0.9" startAngle="0" endAngle="-1.5707964"/>'


@pytest.fixture(scope='module')
def xml() -> dict[str, bytes]:
    return homes.examples()


@pytest.fixture(scope='module')
def imported(xml: dict[str, bytes], tmp_path_factory: pytest.TempPathFactory
             ) -> dict[str, homes.Imported]:
    folder = tmp_path_factory.mktemp('homes')
    return {name: homes.import_case(homes.example_case(name, data, folder), folder)
            for name, data in xml.items()}


@pytest.fixture(scope='module')
def worlds(imported: dict[str, homes.Imported]) -> dict[str, Any]:
    return {name: angen.World(str(made.path)) for name, made in imported.items()}


def is_filled(plan: Plan, frame: Opening) -> bool:
    """Whether the file has a door or a piece of furniture in the same hole."""
    there = [(o.x, o.y) for o in plan.all_openings() if o is not frame]
    there += [(p.x, p.y) for storey in plan.storeys for p in storey.pieces]
    return any(hypot(x - frame.x, y - frame.y) < 0.3 for x, y in there)


def small(tmp_path: Path, *parts: str) -> Path:
    """A room of 4 x 3 m with walls of 20 cm, and further elements."""
    ends = [(0, 0), (400, 0), (400, 300), (0, 300)]
    walls = ''.join(f'<wall id="w{i}" xStart="{a[0]}" yStart="{a[1]}" xEnd="{b[0]}" yEnd="{b[1]}" '
                    'height="250" thickness="20"/>\n'
                    for i, (a, b) in enumerate(zip(ends, ends[1:] + ends[:1])))
    points = ''.join(f'<point x="{x}" y="{y}"/>'
                     for x, y in ((10, 10), (390, 10), (390, 290), (10, 290)))
    path = tmp_path / 'small.xml'
    path.write_text(f'<home wallHeight="250">\n{walls}<room name="Kitchen">{points}</room>\n'
                    + '\n'.join(parts) + '\n</home>')
    return path


def door(x: float, y: float, name: str = 'Door') -> str:
    return (f'<doorOrWindow catalogId="eTeks#door" name="{name}" x="{x}" y="{y}" width="90" '
            f'depth="20" height="208">{SASH}</doorOrWindow>')


def on_levels(path: Path, walls: str, rooms: str) -> None:
    path.write_text(path.read_text().replace('<wall ', f'<wall level="{walls}" ')
                    .replace('<room ', f'<room level="{rooms}" '))


def built(plan: Plan, folder: Path) -> Any:
    """The world of a plan."""
    write_world(plan, folder / 'a.world', 'none')
    return angen.World(str(folder / 'a.world'))


def test_all_nine_are_tested(xml: dict[str, bytes]) -> None:
    assert tuple(xml) == NAMES


@pytest.mark.parametrize('name', NAMES)
def test_counts_are_those_of_the_file(name: str, xml: dict[str, bytes],
                                      imported: dict[str, homes.Imported]) -> None:
    assert homes.in_world(imported[name]) == homes.in_file(xml[name])


@pytest.mark.parametrize('name', NAMES)
def test_rooms_have_the_areas_of_the_file(name: str, xml: dict[str, bytes],
                                          worlds: dict[str, Any]) -> None:
    said = sorted(homes.areas_in_file(xml[name]))
    made = sorted(room['area'] for room in worlds[name].home['rooms'])
    assert len(made) == len(said) and not any(room['guessed'] for room in
                                              worlds[name].home['rooms'])
    assert max(abs(a - b) for a, b in zip(said, made)) < 0.1


@pytest.mark.parametrize('name', NAMES)
def test_leaves_stop_rays_shut_and_let_them_pass_open(name: str, worlds: dict[str, Any],
                                                      imported: dict[str, homes.Imported]) -> None:
    world, plan = worlds[name], imported[name].plan
    link, away = homes.moved(world, 1.0)
    assert away < 1e-3, link
    before = homes.through(world, plan)
    states = homes.open_all(world)
    after = homes.through(world, plan)
    assert all(mode == 'OPEN' for mode, _, _ in states.values()), states
    checked = 0
    for opening in plan.all_openings():
        key = f'{opening.name} {opening.kind}'
        if not opening.leaves and not opening.glass:
            assert before[key] or is_filled(plan, opening), key
        elif not opening.ajar:
            assert not before[key], key
        at = [opening.name] if len(opening.leaves) == 1 else [
            name for _, name in states if name.startswith(opening.name.rstrip('0123456789_'))
            and 'right' in name]
        for leaf in at:
            _, position, _ = states.get((opening.kind, leaf), ('', 0.0, 0.0))
            if abs(position) > 1.2 and len(opening.leaves) == 1:
                checked += 1
                assert after[key], key
    assert checked >= 2


@pytest.mark.parametrize('name', NAMES)
def test_a_person_reaches_rooms_with_doors_from_the_entrance(
        name: str, worlds: dict[str, Any], imported: dict[str, homes.Imported]) -> None:
    assert worlds[name].home['entrance']
    joined, found = homes.reached(imported[name].path, worlds[name].home)
    assert joined and joined <= found


def test_layers_of_one_height_are_one_storey(tmp_path: Path) -> None:
    """Programs draw walls on one level, and rooms and doors on another one at the same height."""
    path = small(tmp_path, '<level id="a" name="A" elevation="0" height="250"/>'
                 '<level id="b" name="B" elevation="0" height="250"/>',
                 door(200, 300).replace('<doorOrWindow', '<doorOrWindow level="b"'))
    on_levels(path, 'a', 'b')
    plan = read_sweethome(path)
    below, above = plan.storeys
    assert [o.name for o in below.openings] == ['kitchen0'] == [r.name for r in below.rooms]
    assert not above.rooms and not above.openings and plan.entrance == 'kitchen0'
    assert not plan.remarks


@pytest.mark.parametrize('name, shown', [('a&#9;b&#10; c', 'a b c'), ('&#9;', 'Floor 0'),
                                         ('x' * 300, 'x' * 40)])
def test_odd_names_of_levels_are_one_line(name: str, shown: str, tmp_path: Path) -> None:
    path = small(tmp_path, f'<level id="a" name="{name}" elevation="0" height="250"/>')
    on_levels(path, 'a', 'a')
    storey, = built(read_sweethome(path), tmp_path).home['storeys']
    assert storey['name'] == shown


def test_a_door_ends_below_the_ceiling(tmp_path: Path) -> None:
    plan = read_sweethome(small(tmp_path, door(200, 300).replace('"208"', '"400"')))
    world = built(plan, tmp_path)
    assert plan.remarks == ['the door "Door" at 2.00 -3.00 is higher than the ceiling, and ends '
                            'below it']
    states = homes.open_all(world)
    assert [mode for mode, _, _ in states.values()] == ['OPEN']


def test_rooms_are_found_beside_a_door_in_a_thicker_wall(tmp_path: Path) -> None:
    path = small(tmp_path, door(200, 300).replace('depth="20"', 'depth="10"'))
    path.write_text(path.read_text().replace('thickness="20"', 'thickness="90"').replace(
        '"10"', '"45"').replace('"390"', '"355"').replace('"290"', '"255"'))
    plan = read_sweethome(path)
    assert [o.name for o in plan.all_openings()] == ['kitchen0'] and plan.entrance == 'kitchen0'


@pytest.mark.parametrize('name, use', [
    ('厨房', 'kitchen'), ('Спальня', 'bedroom'), ('客厅', 'living'), ('Cuarto de baño', 'bathroom'),
    ('コンサート', 'room')])
def test_names_of_other_scripts_give_the_use(name: str, use: str, tmp_path: Path) -> None:
    path = small(tmp_path)
    path.write_text(path.read_text().replace('Kitchen', name))
    plan = read_sweethome(path)
    room, = plan.all_rooms()
    assert room.use == (use if use != 'room' else 'other')
    latin = name.isascii() or 'ñ' in name
    assert room.name == ('cuarto_de_bano0' if latin else f'{use}0')
    assert plan.remarks == ([] if latin else [f'the room "{name}" is called {room.name}'])


def test_a_wall_at_an_angle_and_an_arc_are_as_long_as_in_the_file(tmp_path: Path) -> None:
    path = small(tmp_path, '<wall id="a" xStart="0" yStart="600" xEnd="200" yEnd="600" height="250"'
                 ' thickness="10" arcExtent="3.1415926"/>')
    plan = read_sweethome(path)
    arc = plan.storeys[0].walls[4:]
    assert sum(wall.length for wall in arc) == pytest.approx(pi, rel=0.02)
    middle = arc[len(arc) // 2].start
    # Sweet Home 3D's positive extent bends a wall from west to east toward the top of the page
    assert middle[1] == pytest.approx(-5.0, abs=0.06)
    for a, b in zip(arc, arc[1:]):
        assert a.end == b.start


def test_corners_have_no_gap_and_nothing_twice(tmp_path: Path) -> None:
    made = boxes(read_sweethome(small(tmp_path)).storeys[0].walls, [], 0.0)
    volume = sum(x * y * z for x, y, z in (box.size for box in made))
    assert volume == pytest.approx((4.2 * 3.2 - 3.8 * 2.8) * 2.5, abs=0.01)


def test_a_sloped_wall_has_steps_between_its_heights(tmp_path: Path) -> None:
    path = small(tmp_path, '<wall id="s" xStart="600" yStart="0" xEnd="1000" yEnd="0" height="100" '
                 'heightAtEnd="200" thickness="10"/>')
    walls = read_sweethome(path).storeys[0].walls
    tops = sorted(box.high[2] for box in boxes(walls[4:], [], 0.0))
    assert tops[0] == pytest.approx(1.05, abs=0.01) and tops[-1] == pytest.approx(1.95, abs=0.01)
    assert max(b - a for a, b in zip(tops, tops[1:])) < 0.11


@pytest.mark.parametrize('mirrored, angle, turn', [('false', '0', -1.5708), ('true', '0', 1.5708),
                                                   ('false', '3.14159265', -1.5708)])
def test_a_door_opens_to_the_side_of_its_sash(tmp_path: Path, mirrored: str, angle: str,
                                              turn: float) -> None:
    path = small(tmp_path, '<doorOrWindow catalogId="door" name="Door" x="200" y="300" width="100" '
                 f'depth="20" height="210" angle="{angle}" modelMirrored="{mirrored}">{SASH}'
                 '</doorOrWindow>')
    opening, = read_sweethome(path).all_openings()
    leaf, = opening.leaves
    assert leaf.turn == pytest.approx(turn, abs=1e-3)
    world = built(read_sweethome(path), tmp_path)
    world.command('door', 'kitchen0', 'Open')
    world.run(6)
    assert world.device('door', 'kitchen0')['mode'] == 'OPEN'
    y = world.motion('kitchen_door0::leaf')[0][1]
    link = next(i for i, name in enumerate(world.links) if name == 'kitchen_door0::leaf')
    assert abs(world.link_poses[link][1] - y) < 0.01
    # at angle 0 the front of a piece is the bottom of the page, outside of this room
    assert world.home['doors'][0]['rooms'].count('') == 1


def test_a_slider_slides_before_its_fixed_pane(tmp_path: Path) -> None:
    path = small(tmp_path, '<doorOrWindow catalogId="sliderWindow" name="Slider window" x="200" '
                 'y="300" width="200" depth="20" height="210"/>')
    world = built(read_sweethome(path), tmp_path)
    assert len(world.devices('door')) + len(world.devices('window')) == 1
    kind = 'door' if world.devices('door') else 'window'
    name, = world.devices(kind)
    world.command(kind, name, 'Open')
    world.run(5)
    state = world.device(kind, name)
    assert state['mode'] == 'OPEN' and state['position'] == pytest.approx(0.98, abs=0.02)
    assert state['gap'] == pytest.approx(0.98, abs=0.02)


def test_a_leaf_stops_before_an_obstacle(tmp_path: Path) -> None:
    box = ('<pieceOfFurniture catalogId="x#box" name="Box" x="{}" y="350" width="20" depth="20" '
           'height="100"/>')
    plan = read_sweethome(small(
        tmp_path, door(200, 300).replace('width="90"', 'width="100"'), box.format(190)))
    world = built(plan, tmp_path)
    remark, = (r for r in plan.remarks if 'degrees only' in r)
    assert 'the Box is in its way' in remark
    world.command('door', 'kitchen0', 'Open')
    world.run(6)
    state = world.device('door', 'kitchen0')
    assert state['mode'] == 'OPEN' and 0.2 < abs(state['position']) < 1.2


def test_compass_and_latitude(tmp_path: Path) -> None:
    path = small(tmp_path, f'<compass northDirection="{pi / 2}" latitude="0.8"/>')
    plan = read_sweethome(path)
    # clockwise from the top by 90 degrees: to the right
    assert plan.north == pytest.approx(0.0, abs=1e-9)
    assert plan.latitude == pytest.approx(45.84, abs=0.01)


def test_an_unknown_piece_is_a_box_with_a_remark_and_a_table_of_ones_own_counts(tmp_path: Path
                                                                                ) -> None:
    path = small(tmp_path, '<pieceOfFurniture catalogId="a#b" name="Zorb" x="100" y="100" '
                 'width="50" depth="60" height="70"/>')
    plan = read_sweethome(path)
    assert '"Zorb" is unknown; it is a box of its size' in plan.remarks[0]
    assert f'{path}:' in plan.remarks[0]
    own = tmp_path / 'own.yaml'
    own.write_text('- {word: zorb, thing: sofa, model: sofa}\n')
    piece, = read_sweethome(path, own).storeys[0].pieces
    assert (piece.thing, piece.model) == ('sofa', 'sofa')


def test_a_home_without_rooms_has_those_between_the_walls_of_each_level(tmp_path: Path) -> None:
    levels = ''.join(f'<level id="{name}" name="{name}" elevation="{z}" height="250"/>'
                     for name, z in (('a', 0), ('b', 262), ('c', 524)))
    path = small(tmp_path, levels)
    text = re.sub('<room .*</room>', '', path.read_text())
    walls = ''.join(re.findall('<wall .*/>', text))
    path.write_text(re.sub('(?s)<wall .*/>\n(?=\n)', ''.join(
        walls.replace('<wall ', f'<wall level="{name}" ') for name in 'abc'), text))
    plan = read_sweethome(path)
    assert [len(storey.rooms) for storey in plan.storeys] == [1, 1, 1]
    assert sum('has no <room>; 1 are found' in remark for remark in plan.remarks) == 3


def test_a_home_of_walls_that_are_left_out_says_so(tmp_path: Path) -> None:
    path = small(tmp_path)
    text = path.read_text()
    path.write_text(text.replace('thickness="20"', 'thickness="0"'))
    with pytest.raises(Failure, match='has no <wall> with length, thickness and height; a home'):
        read_sweethome(path)
    path.write_text(re.sub('<wall .*/>', '', text))
    with pytest.raises(Failure, match='has no <wall>; a home needs walls'):
        read_sweethome(path)


def test_a_level_that_is_missing_is_named(tmp_path: Path) -> None:
    path = small(tmp_path, '<level id="l0" name="A" elevation="0" height="250" '
                 'floorThickness="12"/>')
    with pytest.raises(Failure, match=r'small.xml:2: <wall> is on the level "None"'):
        read_sweethome(path)


def test_a_frame_that_a_piece_closes_is_no_way_and_odd_doors_are_reported(tmp_path: Path) -> None:
    def opening(x: int, y: int, sash: str, width: int = 90) -> str:
        return (f'<doorOrWindow name="Door" x="{x}" y="{y}" width="{width}" depth="20" '
                f'height="205" wallThickness="1" wallDistance="0">{sash}</doorOrWindow>')

    gate = '<pieceOfFurniture name="Gate" x="200" y="0" width="250" depth="10" height="205"/>'
    plan = read_sweethome(small(tmp_path, opening(200, 0, '', 250), gate, opening(200, 300, SASH),
                                opening(210, 300, SASH), opening(900, 900, SASH)))
    home = built(plan, tmp_path).home
    assert sorted(door['kind'] for door in home['doors']) == ['door', 'door']
    assert sum('is drawn over another one' in remark for remark in plan.remarks) == 1
    assert sum('is in no wall' in remark for remark in plan.remarks) == 1
    assert sum('is closed by the piece "Gate"' in remark for remark in plan.remarks) == 1


@pytest.mark.parametrize('encoding', ['utf-16', 'utf-8-sig'])
def test_a_file_that_begins_with_the_mark_of_its_encoding(encoding: str, tmp_path: Path) -> None:
    path = small(tmp_path, door(200, 300))
    plain = read_sweethome(path)
    text = path.read_text().replace('Kitchen', 'Küche')
    name = encoding.removesuffix('-sig')
    path.write_bytes(f'<?xml version="1.0" encoding="{name}"?>{text}'.encode(encoding))
    plan = read_sweethome(path)
    assert [room.name for room in plan.all_rooms()] == ['kuche0']
    assert plan.storeys[0].walls == plain.storeys[0].walls
    path.write_bytes(b'\xff\xfe<\x00h')
    with pytest.raises(Failure, match='is not UTF-16, as it begins'):
        read_sweethome(path)


def test_what_is_no_furniture_is_left_out(tmp_path: Path) -> None:
    """A piece on a level that is missing, and a figure for the scale."""
    box = 'x="100" y="100" width="50" depth="50" height="170"'
    path = small(tmp_path, '<level id="a" name="A" elevation="0" height="250"/>',
                 f'<pieceOfFurniture level="b" name="Chest" {box}/>',
                 f'<pieceOfFurniture level="a" name="Standing woman" {box}/>')
    on_levels(path, 'a', 'a')
    plan = read_sweethome(path)
    assert not plan.storeys[0].pieces
    assert [remark.partition(': ')[2] for remark in plan.remarks] == [
        '<pieceOfFurniture> is on the level "b", which is missing; there are a; it is left out',
        '"Standing woman" is a person and is left out']


def test_rooms_between_walls_have_the_use_of_their_contents(tmp_path: Path) -> None:
    path = small(tmp_path, '<pieceOfFurniture name="Cooker" x="50" y="50" width="60" depth="60" '
                 'height="90"/>')
    text = path.read_text()
    path.write_text(text[:text.index('<room')] + text[text.index('</room>') + len('</room>'):])
    plan = read_sweethome(path)
    room, = plan.all_rooms()
    assert (room.use, room.name) == ('kitchen', 'kitchen0')
    assert area(room.polygon) == pytest.approx(3.8 * 2.8, abs=0.1)


def test_the_main_entrance_leads_outside_and_opens(tmp_path: Path) -> None:
    """The leaf of a cupboard within walls does not lead out, and chests stop the front door."""
    cupboard = ''.join(f'<wall xStart="{a}" yStart="{b}" xEnd="{c}" yEnd="{d}" height="250" '
                       'thickness="20"/>' for a, b, c, d in ((0, -80, 400, -80), (0, -80, 0, 0),
                                                             (400, -80, 400, 0)))
    path = small(tmp_path, cupboard, door(200, 0, 'Main cupboard'), door(60, 300, 'Front door'),
                 door(300, 300), *(f'<pieceOfFurniture name="Chest" x="100" y="{y}" width="150" '
                                   'depth="60" height="90"/>' for y in (257, 343)))
    plan = read_sweethome(path)
    assert plan.entrances == ['kitchen_b0', 'kitchen_c0'] and plan.entrance == 'kitchen_b0'
    assert built(plan, tmp_path).home['entrance'] == 'kitchen_c0'


def test_a_large_building_is_divided_into_models(tmp_path: Path, monkeypatch: pytest.MonkeyPatch
                                                 ) -> None:
    walls = ''.join(f'<wall xStart="{x}" yStart="0" xEnd="{x + 60}" yEnd="0" height="250" '
                    'thickness="10"/>\n' for x in range(1000, 5000, 100))
    made = []
    for name in ('whole', 'divided'):
        path = tmp_path / f'{name}.world'
        write_world(read_sweethome(small(tmp_path, walls)), path, 'none')
        made.append([model for model in etree.parse(path).iter('model')
                     if model.get('name').startswith('building0')])
        monkeypatch.setattr(writer, 'ELEMENTS', 200)
        monkeypatch.setattr(writer, 'PARTS', 10)
    whole, divided = made
    assert len(whole) == 1 and len(divided) > 2
    assert all(sum(1 for _ in part.iter()) < 300 for part in divided)
    shapes = [sorted(each.findtext('pose') + each.findtext('geometry/box/size')
                     for part in parts for each in part.iter('collision')) for parts in made]
    assert shapes[0] == shapes[1] and len(shapes[0]) > 44
    world = angen.World(str(tmp_path / 'divided.world'))
    assert [room['name'] for room in world.home['rooms']] == ['kitchen0']


def test_a_world_that_cannot_be_read_is_not_written(tmp_path: Path) -> None:
    links = '<link name="a"/>' * 10_001  # more than the simulator reads in a model
    text = f'<sdf version="1.9"><world name="w"><model name="m">{links}</model></world></sdf>'
    with pytest.raises(Failure, match='cannot be read again: .* elements in one model'):
        writer._write_checked(tmp_path / 'b.world', text)
    assert list(tmp_path.iterdir()) == []
