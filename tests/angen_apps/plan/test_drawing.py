"""The drawing that a world contains: the same world comes of it again, and bad ones are refused."""
import json
import random
from pathlib import Path
from typing import Any

import pytest
from angen_apps.plan.drawing import Drawing, from_json, kept, recovered, to_json
from angen_apps.plan.finish import finish
from angen_apps.plan.model import Mover, Plan, Sensor, Storey
from angen_apps.plan.tower import building
from angen_apps.plan.writer import world_of, write_world
from angen_tools.common.failure import Failure
from lxml import etree

WORLD = '<sdf version="1.9"/>\n'
SEEDS = [(3, 1, 1, 7, 'seed'), (2, 2, 2, 3, 'casas')]


def small() -> dict[str, Any]:
    """A drawing with one wall, a door, a table and a sensor."""
    return {'plan': {'name': 'home', 'storeys': [{
        'number': 0, 'name': 'Ground floor', 'elevation': 0, 'height': 2.5,
        'walls': [{'start': [0, 0], 'end': [4, 0], 'thickness': 0.1, 'bottom': 0, 'top': 2.5}],
        'openings': [{'kind': 'door', 'x': 2, 'y': 0, 'yaw': 0, 'width': 0.9, 'bottom': 0,
                      'top': 2, 'band': [-0.05, 0.05],
                      'leaves': [{'hinge': [-0.45, 0], 'width': 0.9, 'shut': 0, 'turn': 1}]}],
        'pieces': [{'name': 'a -- b', 'x': 1, 'y': 1, 'z': 0, 'yaw': 0, 'width': 1, 'depth': 1,
                    'height': 1}],
        'sensors': [{'name': '', 'model': 'pir', 'x': 1, 'y': 0.2, 'z': 2}]}]}, 'sensors': 'none'}


@pytest.mark.parametrize('rooms, floors, apartments, seed, sensors', SEEDS)
def test_a_drawing_gives_the_world_in_which_it_is(tmp_path: Path, rooms: int, floors: int,
                                                  apartments: int, seed: int, sensors: str) -> None:
    path, again = tmp_path / 'home.world', tmp_path / 'again.world'
    write_world(building(rooms, floors, apartments, seed), path, sensors)
    drawing = recovered(path.read_text(), str(path))
    assert drawing.sensors == sensors
    write_world(finish(drawing.plan), again, sensors,
                from_json(to_json(recovered(path.read_text(), '')), 'it'))
    assert again.read_bytes() == path.read_bytes()


def test_json_gives_the_same_drawing() -> None:
    text = json.dumps(to_json(from_json(small(), 'it')))
    assert json.dumps(to_json(from_json(json.loads(text), 'it'))) == text
    world = kept(WORLD, from_json(small(), 'it'))
    negated = small()
    negated['plan']['storeys'][0]['walls'][0]['start'] = [0, -0.0]  # JavaScript's JSON has 0
    assert kept(WORLD, from_json(negated, 'it')) == world
    assert '--' not in world.split('<!--')[1].split('-->')[0]  # XML does not allow it
    etree.fromstring(world)
    assert recovered(world, 'it') == from_json(small(), 'it')


def test_a_plan_has_sensors_people_and_robots_of_its_own() -> None:
    storey = Storey(0, 'Ground floor', 0.0, 2.5,
                    sensors=[Sensor('', 'pir', 1.0, 1.0, 2.0), Sensor('', 'pir', 2.0, 1.0, 2.0)],
                    movers=[Mover('<ann>', 'person', 1.0, 2.0), Mover('', 'robot', 3.0, 2.0)])
    root, _ = world_of(finish(Plan('home', [storey])), 'none')
    names = root.xpath('world/include/name/text() | world/actor/@name')
    assert {'pir0', 'pir_b0', 'ann', 'robot'} <= set(names)


@pytest.mark.parametrize('world, why', [
    (WORLD, 'has no drawing to edit'),
    (kept(WORLD, from_json(small(), 'it')).replace('1.9', '1.8'), 'was changed by hand'),
    (kept(WORLD, from_json(small(), 'it')).replace('"kind":"door"', '"kind":"gate"'),
     r'leaves|openings\[0\].kind is gate, must be door')])
def test_a_world_without_a_drawing_says_why(world: str, why: str) -> None:
    with pytest.raises(Failure, match=why):
        recovered(world, 'home.world')


def changed(path: str, value: Any) -> dict[str, Any]:
    """The small drawing with another value."""
    data = small()
    at: Any = data['plan']['storeys'][0]
    *keys, last = path.split('.')
    for key in keys:
        at = at[int(key) if key.isdigit() else key]
    at[last] = value
    return data


@pytest.mark.parametrize('data, why', [
    ([], 'must be {"plan"'), ({'plan': {}}, 'plan has no name'),
    ({'plan': {'name': 'x', 'storeys': []}}, 'at least one'),
    (changed('walls.0.start', [0]), r'storeys\[0\].walls\[0\].start must be a list of 2'),
    (changed('walls.0.start', [0, 1e300]), 'must be a finite number'),
    (changed('walls.0.start', [0, float('nan')]), 'must be a finite number'),
    (changed('walls.0.end', [900, 0]), 'more than 500 m'),
    (changed('walls.0.thickness', -1), 'must not be negative'),
    (changed('walls.0.thickness', True), 'must be a finite number'),
    (changed('walls', {}), 'must be a list'), (changed('walls', [0] * 5001), 'at most 5000'),
    (changed('pieces.0.model', '../../../etc/passwd'), 'letters, digits and _'),
    (changed('sensors.0.model', 'a/b'), 'letters, digits and _'),
    (changed('pieces.0.mesh', '../../x.obj'), 'letters, digits and _'),
    (changed('pieces.0.name', 'x\x00y'), 'none of them of control'),
    (changed('pieces.0.name', 'x\ud800y'), 'none of them of control'),
    (changed('pieces.0.name', 'x' * 300), 'at most 200 characters'),
    (changed('pieces.0.shape', 'ball'), 'must be box, cylinder'),
    (changed('pieces.0.legs', 4), 'legs is not known'),
    (changed('number', 0.5), 'must be a whole number'),
    ({**small(), 'sensors': 'all'}, 'sensors must be seed, casas, none')])
def test_bad_drawings_are_refused(data: Any, why: str) -> None:
    with pytest.raises(Failure, match=why):
        from_json(data, 'the drawing')


def test_no_json_is_more_than_refused() -> None:
    rng = random.Random(7)
    values = [None, True, -1, 1e999, 'x', [], {}, [[]], {'x': 1}, 10 ** 400, '\u202e', small()]

    def parts(data: Any) -> list[tuple[Any, Any]]:
        keys = list(data) if isinstance(data, dict) else range(
            len(data)) if isinstance(data, list) else []
        return [(data, key) for key in keys] + [each for key in keys for each in parts(data[key])]

    refused = 0
    for _ in range(300):
        data = small()
        holder, key = rng.choice(parts(data))
        holder[key] = rng.choice(values)
        try:
            assert isinstance(from_json(data, 'it'), Drawing)
        except Failure:
            refused += 1
    assert refused > 200
