"""200 damaged files: each ends with one line that says what and where, and writes nothing."""
import functools
import io
import random
import re
import zipfile
from pathlib import Path

import pytest

from angen_apps.imports import things
from angen_bench import homes
from angen_tools.cli import main as cli
from tests.angen_apps.imports.measured import import_measured

COUNT = 200
MEMORY, SECONDS = 200 << 20, 2.0  # bytes and s of CPU time
HUGE = 40 << 20  # bytes of a bomb's text
BUILDING = '''levels:
  L1:
    elevation: 0
    measurements: [[0, 1, {distance: [3, 10]}]]
    vertices: [[0, 0, 0, ""], [100, 0, 0, ""], [100, 80, 0, ""], [0, 80, 0, ""], [40, 0, 0, ""]]
    walls: [[0, 1, {}], [1, 2, {}], [2, 3, {}], [3, 0, {}]]
    doors: [[0, 4, {type: [1, hinged], name: [1, d]}]]
lifts: {}
'''


READ = ('wall', 'doorOrWindow', 'sash', 'light', 'pieceOfFurniture')


def tag_before(text: str, place: int) -> str:
    """The name of the element that an attribute at a place belongs to."""
    return text[text.rfind('<', 0, place) + 1:].split(None, 1)[0]


def zipped(name: str, data: bytes) -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, 'w', zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, data)
    return made.getvalue()


def cases(xml: bytes) -> list[tuple[str, bytes]]:
    """Ending and bytes of each damaged file; the same at every run."""
    dice = random.Random(27)
    text = xml.decode()
    whole = zipped('Home.xml', xml)
    found: list[tuple[str, bytes]] = [
        ('sh3d', b''), ('xml', b''), ('sh3d', b'PK'), ('sh3d', zipped('../Home.xml', xml)),
        ('sh3d', zipped('Home', b'\xac\xed\x00\x05')), ('sh3d', zipped('Home.xml', b' ' * HUGE)),
        ('sh3d', zipped('Home.xml', b'<home>' + b'<a/>' * 200_000 + b'</home>')),
        ('xml', b'<home><!ENTITY a "b"></home>'),
        ('xml', b'<?xml version="1.0"?><!DOCTYPE h [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>'
                b'<home>&b;</home>'),
        ('xml', b'<room/>'), ('xml', b'<home/>'), ('xml', b'\x00' * 100),
        ('building.yaml', b'levels: !!python/object/apply:os.system ["true"]'),
        ('building.yaml', b'a: &a [x]\nb: [' + b'*a,' * 500 + b']'), ('building.yaml', b'a: ['),
        ('building.yaml', b'levels: 3'), ('building.yaml', b'levels: {}'),
        ('building.yaml', BUILDING.replace('3, 10', '3, .nan').encode()),
        ('building.yaml', BUILDING.replace('[0, 1, {distance: [3, 10]}]', '').encode()),
        ('building.yaml', BUILDING.replace('[3, 0, {}]', '[3, 99, {}]').encode()),
        ('building.yaml', BUILDING.replace('hinged', 'revolving').encode()),
        ('building.yaml', BUILDING.replace('lifts: {}', 'lifts: {a: {x: 1}}').encode())]
    numbers = [hit for hit in re.finditer(r" (?:xStart|yEnd|width|depth|xAxis)='[^']*'", text)
               if tag_before(text, hit.start()) in READ]
    points = list(re.finditer(r"<point x='[^']*'", text))
    while len(found) < COUNT:
        way = len(found) % 4
        if way == 0:  # torn
            found.append(('sh3d', whole[:dice.randrange(1, len(whole) - 1)]))
        elif way == 1:  # not a number, or missing
            hit = dice.choice(numbers)
            key = hit[0].partition('=')[0]
            bad = dice.choice(['', f'{key}="nan"', f'{key}="1e999"', f'{key}="12,5"',
                               f'{key}="-1e9"'])
            found.append(('xml', (text[:hit.start()] + bad + text[hit.end():]).encode()))
        elif way == 2:  # a corner out of place
            hit = dice.choice(points)
            bad = dice.choice(['<point x="inf"', '<point', '<point x="9e9"', '<point x="a"'])
            found.append(('xml', (text[:hit.start()] + bad + text[hit.end():]).encode()))
        else:  # torn XML
            found.append(('xml', xml[:dice.randrange(1, len(xml) - 10)]))
    return found


def test_damaged_files_end_with_one_line_and_leave_nothing(
        tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
        ) -> None:
    monkeypatch.setattr(cli, 'make_parser', functools.cache(cli.make_parser))  # 20 ms a file
    out = tmp_path / 'out' / 'home.world'
    wrong = []
    things.table()  # once, not in each of the processes that read
    for i, (ending, data) in enumerate(cases(homes.examples()['Studio'])):
        path = tmp_path / f'case{i}.{ending}'
        path.write_bytes(data)
        code = cli.run(['import', str(path), '-o', str(out)])
        said = capsys.readouterr()
        lines = said.err.splitlines()
        if code != 1 or len(lines) != 1 or path.name not in lines[0] or said.out:
            wrong.append((i, ending, code, said.err[-300:]))
        path.unlink()
    assert not wrong
    assert not out.parent.exists()


@pytest.mark.parametrize('elements, attributes, what', [
    (0, 80_000, '100 attributes'), (0, 2_000_000, '100 attributes'),
    (8_000_000, 0, '400000 elements')])
def test_a_large_file_costs_little(elements: int, attributes: int, what: str, tmp_path: Path
                                   ) -> None:
    xml = (b'<home ' + b' '.join(b'a%d="1"' % i for i in range(attributes)) + b'>'
           + b'<a/>' * elements + b'</home>')
    (tmp_path / 'home.sh3d').write_bytes(zipped('Home.xml', xml))
    done = import_measured(tmp_path / 'home.sh3d')
    assert done.code == 1 and done.memory < MEMORY and done.cpu < SECONDS
    assert 'home.sh3d/Home.xml:1: has ' in done.said and what in done.said
    assert len(done.said.splitlines()) == 1


def test_a_room_that_crosses_itself_is_rejected(tmp_path: Path, capsys: pytest.CaptureFixture[str]
                                                ) -> None:
    path = tmp_path / 'home.xml'
    path.write_text('<home>\n<wall xStart="0" yStart="0" xEnd="100" yEnd="0" thickness="10"/>\n'
                    '<room name="Bow"><point x="0" y="0"/><point x="100" y="100"/>'
                    '<point x="100" y="0"/><point x="0" y="120"/></room></home>')
    assert cli.run(['import', str(path), '-o', str(tmp_path / 'a.world')]) == 1
    assert 'home.xml:3: the room "Bow" crosses itself' in capsys.readouterr().err
    assert not (tmp_path / 'a.world').exists()
