"""A home that is edited: its draft, its file, two who edit it, a disk that is full."""
import json
from pathlib import Path
from typing import Any, Iterator

import angen
import pytest
from angen_apps.edit.desk import Conflict, Desk, in_use
from angen_apps.edit.worker import Worker
from angen_apps.plan.tower import building
from angen_apps.plan.writer import write_world
from angen_apps.residents.profiles import read
from angen_tools.common.failure import Failure
from angen_tools.world import models

HOSTILE = ('<img src=x onerror=alert(1)>', '--><world name="x">', '../../etc/passwd', '厨房',
           '\u202etxt', "'; rm -rf /", '$(reboot)', '__proto__', ' ')


@pytest.fixture(scope='module')
def worker() -> Iterator[Worker]:
    made = Worker()
    yield made
    made.end()


def wall(start: list[float], end: list[float]) -> dict[str, Any]:
    return {'start': start, 'end': end, 'thickness': 0.1, 'bottom': 0, 'top': 2.5}


def drawn(name: str = 'kitchen') -> dict[str, Any]:
    """A room with a door to the outside, a table, a sensor, a person and a robot."""
    corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]
    return {'plan': {'name': 'home', 'storeys': [{
        'number': 0, 'name': 'Ground floor', 'elevation': 0, 'height': 2.5,
        'walls': [wall(*pair) for pair in zip(corners, corners[1:] + corners[:1])],
        'openings': [{'kind': 'door', 'x': 2, 'y': 0, 'yaw': 0, 'width': 0.87, 'bottom': 0,
                      'top': 2.05, 'band': [-0.05, 0.05], 'source': 'door',
                      'leaves': [{'hinge': [-0.43, 0.05], 'width': 0.86, 'shut': 0,
                                  'turn': 1.5708}]}],
        'labels': [{'name': name, 'x': 1, 'y': 1}],
        'pieces': [{'name': name, 'source': 'table', 'thing': 'table', 'model': 'table', 'x': 3,
                    'y': 2.4, 'z': 0, 'yaw': 0, 'width': 0.7, 'depth': 1, 'height': 0.75}],
        'sensors': [{'name': name, 'model': 'pir', 'x': 0.2, 'y': 0.2, 'z': 2.2, 'yaw': 0.785}],
        'movers': [{'name': name, 'kind': 'person', 'x': 1, 'y': 2, 'habits': 'worker'},
                   {'name': name, 'kind': 'robot', 'x': 2, 'y': 2}]}]}, 'sensors': 'none'}


def test_a_home_is_drawn_kept_saved_and_opened_again(tmp_path: Path, worker: Worker) -> None:
    path = tmp_path / 'home.world'
    desk = Desk(path, worker)
    assert desk.opened()['drawing'] is None and not desk.opened()['reason']
    desk.keep(drawn(), 5.0, desk.version)
    assert Desk(path, worker).opened()['draft'] == {'at': 5.0, 'drawing': drawn()}
    assert not desk.opened()['saved']
    text = desk.save(drawn(), desk.version, False)
    assert desk.opened()['saved']
    assert '1 room, 4 walls, 1 door' in text and not desk.draft.exists()
    again = Desk(path, worker).opened()
    assert again['draft'] is None
    assert again['drawing']['plan']['storeys'][0]['labels'] == [
        {'name': 'kitchen', 'x': 1.0, 'y': 1.0}]
    world = angen.World(str(path))
    names = {(kind, name) for kind, name, *_ in world.entities()}
    assert {('door', 'kitchen0'), ('pir', 'kitchen0'), ('person', 'kitchen')} <= names
    assert [room['name'] for room in world.home['rooms']] == ['kitchen0']
    first = path.read_bytes()
    desk.save(again['drawing'], desk.version, False)
    assert path.read_bytes() == first


@pytest.mark.parametrize('name', HOSTILE)
def test_any_name_gives_a_world_that_loads(tmp_path: Path, worker: Worker, name: str) -> None:
    desk = Desk(tmp_path / 'home.world', worker)
    try:
        desk.save(drawn(name), 0, False)
    except Failure as failure:
        assert name == '\u202etxt' and 'none of them of control' in str(failure)
        return
    angen.World(str(desk.path))
    assert Desk(desk.path, worker).opened()['drawing'] is not None


def test_a_drawn_home_has_a_clock_and_what_its_sensors_measure(tmp_path: Path, worker: Worker
                                                               ) -> None:
    desk, data = Desk(tmp_path / 'home.world', worker), drawn()
    data['plan']['start'] = '2026-03-23T07:00:00'
    data['plan']['storeys'][0]['sensors'].append(
        {'name': 'air', 'model': 'temperature_sensor', 'x': 2, 'y': 2.9, 'z': 1.5, 'yaw': -1.57})
    desk.save(data, desk.version, False)
    assert desk.opened()['drawing'] == data
    world = angen.World(str(desk.path))
    world.run(2.0)
    assert world.home['start'] == data['plan']['start']
    warm = world.sensor('temperature', 'air0')['temperature']
    assert warm == pytest.approx(20.0, abs=1.0)


def test_rooms_and_findings_of_a_drawing(tmp_path: Path, worker: Worker) -> None:
    desk = Desk(tmp_path / 'home.world', worker)
    found = desk.survey(drawn('bathroom'))
    assert [(room['name'], room['use']) for room in found['rooms']] == [('bathroom', 'bathroom')]
    assert found['findings'] == [] and found['ruled'] == []
    ruled = desk.survey({**drawn(), 'sensors': 'seed'})['ruled']
    assert sorted(sensor['model'] for sensor in ruled) == ['luminosity_sensor', 'pir', 'pir']
    shut = drawn()
    del shut['plan']['storeys'][0]['openings']
    assert any('outside' in text for text in desk.survey(shut)['findings'])
    assert not list(tmp_path.iterdir())


def two_floors() -> dict[str, Any]:
    """The room twice, with an elevator beside it; one lives below and one stands above."""
    data = drawn('hall')
    ground, = data['plan']['storeys']
    ground['height'] = 3
    corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]
    walls = [{**wall(*pair), 'bottom': 3, 'top': 5.5}
             for pair in zip(corners, corners[1:] + corners[:1])]
    data['plan']['storeys'].append({
        'number': 1, 'name': 'Floor 1', 'elevation': 3, 'height': 2.5, 'slab': 0.49,
        'walls': walls, 'labels': [{'name': 'bedroom', 'x': 1, 'y': 1}],
        'movers': [{'name': 'upstairs', 'kind': 'person', 'x': 1, 'y': 2}]})
    data['plan']['lifts'] = [{'name': 'elevator', 'x': 5.1, 'y': 1.5, 'yaw': 3.1415927,
                              'width': 1.58, 'depth': 1.5, 'stops': [0, 1], 'front': 0.98}]
    return data


def test_people_take_the_elevator_of_a_home_with_two_floors(tmp_path: Path, worker: Worker
                                                            ) -> None:
    desk = Desk(tmp_path / 'home.world', worker)
    found = desk.survey(two_floors(), 1)
    assert found['findings'] == [] and [room['name'] for room in found['rooms']] == [
        'hall', 'bedroom']
    assert found['coverage']['rooms'] == {'bedroom1': 0.0}  # no sensor is there
    text = desk.save(two_floors(), 0, False)
    assert '2 floors, 2 rooms' in text and '1 lift' in text
    world = angen.World(str(desk.path))
    assert [landing['room'] for landing in world.home['elevators'][0]['landings']] == [
        'hall0', 'bedroom1']
    world.run(1.0)
    assert world.device('person', 'upstairs')['z'] == pytest.approx(3.0, abs=0.01)
    world.command('person', 'hall', 'GoTo bedroom1')
    world.run(60.0)
    state = world.device('person', 'hall')
    assert not state['going'] and state['z'] == pytest.approx(3.0, abs=0.01)
    first = desk.path.read_bytes()
    desk.save(Desk(desk.path, worker).drawing, desk.version, False)
    assert desk.path.read_bytes() == first


@pytest.mark.parametrize('stops', [[], [0, 7], [3]])
def test_a_lift_that_stops_nowhere_is_refused(tmp_path: Path, worker: Worker, stops: list[int]
                                              ) -> None:
    data = two_floors()
    data['plan']['lifts'][0]['stops'] = stops
    with pytest.raises(Failure, match=r'plan.lifts\[0\].stops must be numbers of storeys'):
        Desk(tmp_path / 'home.world', worker).survey(data, 0)


def test_a_day_that_was_drawn_is_saved_as_a_profile(tmp_path: Path, worker: Worker) -> None:
    data = drawn()
    person = data['plan']['storeys'][0]['movers'][0]
    person['day'] = [{'do': ['wake'], 'low': 25200, 'high': 27000},
                     {'do': ['sleep'], 'low': 79200, 'high': 81000}]
    desk = Desk(tmp_path / 'home.world', worker)
    assert desk.save(data, 0, False).endswith('1 piece')
    assert read(str(tmp_path / 'home_kitchen.yaml')).wakes['weekday'].low == 25200
    assert 'kitchen: home_kitchen.yaml' in (tmp_path / 'home_residents.yaml').read_text()
    assert desk.household(data) == {'kitchen': str(tmp_path / 'home_kitchen.yaml')}
    del person['day'][1]
    assert any('the day of kitchen must say' in text for text in desk.survey(data)['findings'])
    assert 'the day of kitchen must say' in desk.save(data, desk.version, False)
    assert desk.opened()['drawing'] == data  # the world is saved


def test_the_second_who_changes_a_home_is_told(tmp_path: Path, worker: Worker) -> None:
    desk = Desk(tmp_path / 'home.world', worker)
    opened = desk.version
    desk.keep(drawn('kitchen'), 1.0, opened)
    for change in (lambda: desk.keep(drawn('hall'), 2.0, opened),
                   lambda: desk.save(drawn('hall'), opened, False), lambda: desk.discard(opened)):
        with pytest.raises(Conflict, match='another window'):
            change()
    assert desk.opened()['draft']['drawing'] == drawn('kitchen')


def test_a_file_that_another_program_changed_is_kept(tmp_path: Path, worker: Worker) -> None:
    desk = Desk(tmp_path / 'home.world', worker)
    desk.save(drawn(), 0, False)
    desk.path.write_text('<sdf/>')
    with pytest.raises(Conflict, match='changed by another program'):
        desk.save(drawn(), desk.version, False)
    assert desk.path.read_text() == '<sdf/>'
    desk.save(drawn(), desk.version, True)
    assert '<world' in desk.path.read_text()


def test_a_file_is_edited_by_one_program(tmp_path: Path) -> None:
    path = tmp_path / 'home.world'
    with in_use(path):
        with pytest.raises(Failure, match='another angen edit has it open'):
            in_use(tmp_path / '.' / 'home.world')
        in_use(tmp_path / 'other.world').close()
    in_use(path).close()


def test_a_full_disk_loses_nothing(tmp_path: Path, worker: Worker) -> None:
    desk = Desk(tmp_path / 'home.world', worker)
    desk.save(drawn(), 0, False)
    before = desk.path.read_bytes()
    desk.draft.symlink_to('/dev/full')
    with pytest.raises(Failure, match='No space left'):
        desk.keep(drawn('hall'), 1.0, desk.version)
    desk.draft.unlink()
    (tmp_path / '.home.world.part').symlink_to('/dev/full')
    desk.keep(drawn('hall'), 1.0, desk.version)
    with pytest.raises(Failure, match='No space left'):
        desk.save(drawn('hall'), desk.version, False)
    assert desk.path.read_bytes() == before
    assert desk.opened()['draft']['drawing'] == drawn('hall')


@pytest.mark.parametrize('data, why', [
    ('<sdf version="1.6"><world name="w"/></sdf>', 'has no drawing to edit'), ('', 'no drawing'),
    ('not XML', 'no drawing')])
def test_a_world_by_hand_is_read_only(tmp_path: Path, worker: Worker, data: str, why: str) -> None:
    path = tmp_path / 'home.world'
    path.write_text(data)
    desk = Desk(path, worker)
    assert why in desk.opened()['reason']
    with pytest.raises(Failure, match=why):
        desk.save(drawn(), 0, True)
    assert path.read_text() == data


def test_a_home_by_seed_is_edited(tmp_path: Path, worker: Worker) -> None:
    path = tmp_path / 'home.world'
    write_world(building(1, 1, 1, 3), path, 'seed')
    before = path.read_bytes()
    desk = Desk(path, worker)
    assert not desk.opened()['reason']
    desk.save(desk.drawing, 0, False)
    assert path.read_bytes() == before


def test_a_damaged_draft_is_set_aside_with_one_line(
        tmp_path: Path, worker: Worker, capsys: pytest.CaptureFixture[str]) -> None:
    desk = Desk(tmp_path / 'home.world', worker)
    huge = f'{{"at": 1{400 * "0"}, "drawing": {json.dumps(drawn())}}}'
    damaged = ('', '{}', '[' * 10_000, json.dumps({'at': 'x', 'drawing': {}}), '\udcff', huge,
               huge.replace('0' * 400, '0' * 5000),
               json.dumps({'at': 1, 'drawing': {'plan': {'name': 'x', 'storeys': []}}}))
    for number, text in enumerate(damaged, 1):
        desk.draft.write_text(text, errors='surrogateescape')
        assert desk.opened()['draft'] is None
        aside = tmp_path / f'home.world.draft.damaged{number if number > 1 else ""}'
        assert aside.read_text(errors='surrogateescape') == text and not desk.draft.exists()
        line = capsys.readouterr().err
        assert line.count('\n') == 1 and str(desk.draft) in line
        assert line.endswith(f'; it is now {aside.name}\n')
    assert desk.opened()['draft'] is None and not capsys.readouterr().err
    desk.keep(drawn(), 5.0, desk.version)
    assert desk.opened()['draft'] == {'at': 5.0, 'drawing': drawn()}


def test_the_models_of_the_catalog_are_there(worker: Worker) -> None:
    from angen_apps.edit.catalog import catalog
    made = worker.run('the catalog', catalog)
    named = [each['model'] for each in made['pieces'] + made['sensors'] if each['model']]
    assert all(models.find(f'model://{name}') for name in named)
    pir = next(each for each in made['sensors'] if each['model'] == 'pir')
    assert pir['right'] < 0 < pir['left'] and pir['far'] > 2
