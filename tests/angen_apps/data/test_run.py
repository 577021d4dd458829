"""A resident in the simulated apartment: a quarter of an hour, checked against itself."""
import datetime
import gzip
import json
import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import angen
import pytest

from angen_apps.data.formats import FORMATS
from angen_apps.data.generate import Job, check, finished, jobs, write_truth
from angen_apps.data.recorder import Recorder
from angen_apps.data.run import Data, residents_of
from angen_apps.data.site import Site, apartment
from angen_apps.data.validate import validate
from angen_apps.residents.household import Household
from angen_apps.residents.members import make
from angen_apps.residents.profiles import read
from angen_tools.common.failure import Failure

MORNING = 30180.0  # s after midnight, a minute before the carer comes (seed 5)
SECONDS = 700.0


@pytest.fixture(scope='module')
def home(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp('home') / 'home.world'
    apartment(path)
    return path


@pytest.fixture(scope='module')
def lived(home) -> Data:
    return morning(home)


def morning(home: Path) -> Data:
    """A carer, who comes in the morning."""
    site = Site(home, 7)
    day = datetime.date(2026, 3, 23)
    household = Household(site.simulator, site.floors, 5, 'home', day, MORNING)
    who = residents_of(['carer'])
    make(household, who)
    recorder = Recorder(site, household)
    recorder.start()
    household.run(SECONDS)
    household.close()
    left = recorder.recording
    truth = [i for resident in household.residents for i in resident.diary.closed]
    return Data(datetime.datetime(2026, 3, 23), 1, 3, who, site.home,
                site.sensors, sorted(left.events, key=lambda e: (e.time, e.sensor)), truth,
                left.missed, left.power, left.track, left.faults, recorder.cabins.slides)


def test_who_comes_home_walks_in_and_is_detected(lived, tmp_path):
    phases = [interval.phase for interval in lived.truth]
    assert phases[0] == 'away' and 'goes' in phases and 'does' in phases
    entrance = next(s.id for s in lived.sensors if s.name == 'entrance0_contact')
    opened = [e for e in lived.events if (e.sensor, e.value) == (entrance, 'OPEN')]
    assert opened and opened[0].resident == 'anna' and opened[0].cause == 'hand'
    seen = {e.sensor for e in lived.events if e.value == 'ON' and e.cause == 'motion'}
    assert len(seen) >= 3
    assert not [e for e in lived.events if e.cause == 'noise']
    FORMATS['csv'](tmp_path, lived)
    FORMATS['casas'](tmp_path, lived)
    write_truth(tmp_path, lived)
    findings = validate(tmp_path)
    ends = [line for line in findings.wrong['no gap in the truth'] if 'ends at' not in line]
    assert not ends  # the day is not over
    assert findings.checked['no resident crossed a wall'] >= 2
    assert findings.checked['the mains report what all loads draw'] >= 2
    assert {watts for _, watts in lived.power['fridge/kitchen_fridge0']} <= {0.0, 80.0}
    assert {e.value for e in lived.events if e.sensor == 'P001' and e.time < 1.0} <= {'0', '80'}
    assert {check: wrong for check, wrong in findings.wrong.items()
            if wrong and check not in ('no gap in the truth', 'a file is as it is listed')} == {}


def test_the_same_morning_has_the_same_bytes(lived, home):
    again = morning(home)
    assert (again.events, again.track) == (lived.events, lived.track)
    assert [i.row() for i in again.truth] == [i.row() for i in lived.truth]


def crossed(lived: Data, folder: Path, rows: list[str], change=None) -> list[str]:
    """The steps across walls that validate finds in a track, in a layout that is changed."""
    FORMATS['csv'](folder, lived)
    write_truth(folder, lived)
    if change:
        layout = json.loads((folder / 'layout.json').read_text())
        (folder / 'layout.json').write_text(json.dumps(layout | change(layout['rooms'][0])))
    with gzip.open(folder / 'track.csv.gz', 'wt') as file:
        file.write('\n'.join(['time,resident,x,y,storey', *rows]) + '\n')
    return validate(folder).wrong['no resident crossed a wall']


def test_validate_finds_walls(lived, tmp_path):
    rows = ['5000.0,anna,3.900,2.000,0', '5000.4,anna,4.100,2.000,0']  # kitchen to living room
    assert len(crossed(lived, tmp_path, rows)) == 1


def test_validate_knows_a_room_within_another(lived, tmp_path):
    core = [[2.0, 2.0], [4.0, 2.0], [4.0, 4.0], [2.0, 4.0]]
    ring = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]]
    wrong, = crossed(
        lived, tmp_path, ['5000.0,anna,1.9,3.0,0', '5000.4,anna,2.1,3.0,0'],
        lambda room: {'doors': [], 'rooms': [
            {**room, 'name': name, 'storey': 0, 'polygon': polygon, 'holes': holes, 'area': size}
            for name, polygon, holes, size in (('hall', ring, [core], 32.0),
                                               ('bathroom', core, [], 4.0))]})
    assert 'from hall' in wrong and 'to bathroom' in wrong


def test_validate_lets_a_step_board_an_elevator(lived, tmp_path):
    """The cabin is in no room, and the landing's edge is no wall before it."""
    wrong, = crossed(
        lived, tmp_path, ['5000.0,anna,0.1,3.1,0', '5000.4,anna,-0.2,3.1,0',
                          '6000.0,anna,0.1,4.1,0', '6000.4,anna,-0.2,4.1,0'],
        lambda room: {
            'doors': [], 'landings': [{'elevator': 'e', 'storey': 0,
                                       'pose': [1.0, 3.0, 0.0, math.pi]}],
            'rooms': [{**room, 'name': 'landing', 'storey': 0, 'holes': [], 'area': 36.0,
                       'polygon': [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]]}]})
    assert wrong.startswith('anna at 6000.4')


def test_validate_lets_a_step_pass_an_opening_aslant(lived, tmp_path):
    door = next(d for d in lived.home.doors if d.name == 'kitchen0')
    x, y = door.pose[0] + 0.45 * door.width, door.pose[1]  # of its edge; its leaf is along x
    wrong, = crossed(lived, tmp_path, [
        f'5000.0,anna,{x - 0.1},{y - 0.1},0', f'5000.5,anna,{x + 0.35},{y + 0.4},0',
        f'6000.0,anna,{x + 0.3},{y - 0.1},0', f'6000.5,anna,{x + 0.35},{y + 0.4},0'])
    assert wrong.startswith('anna at 6000.5')


def test_validate_finds_activities_elsewhere_and_ways_that_are_given_up(lived, tmp_path):
    does = next(i for i in lived.truth if i.phase == 'does')
    cooks = replace(does, activity='cook', room='bathroom0', thing='')
    lost = replace(does, note='gave up the way')
    FORMATS['csv'](tmp_path, lived)
    write_truth(tmp_path, replace(lived, truth=[*lived.truth, cooks, lost, lost]))
    wrong = validate(tmp_path).wrong
    assert [line.partition(': ')[2] for line in wrong['an activity is in a room for it']] \
        == ['cook stand at no thing in bathroom0']
    assert [line.partition(',')[0] for line in wrong['few ways are given up']] \
        == [f'anna: 2 of {sum(i.phase == "goes" for i in lived.truth)}']


def test_residents_sleep_on_the_floor_of_a_home_without_a_bed(home, tmp_path, capfd):
    text = home.read_text()
    for name in ('bedroom_bed0', 'livingroom_sofa0'):
        start = text.rindex('<include>', 0, text.index(name))
        text = text[:start] + text[text.index('</include>', start) + len('</include>'):]
    path = tmp_path / 'bare.world'
    path.write_text(text)
    site = Site(path, 7, placed=False)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23))
    anna, bert, *_ = make(household, [(name, read('retired')) for name in ('anna', 'bert')])
    household.run(60.0)  # at midnight
    for sleeper in (anna, bert):
        assert (sleeper.posture, sleeper.room) == ('lie', 'bedroom0')
        assert site.simulator.body(sleeper.name).z == pytest.approx(0.0, abs=0.02)
    assert math.dist(anna.at, bert.at) > 1.0
    assert 'anna (retired) does sleep on the floor of bedroom0: the home has no bed and no sofa ' \
        in capfd.readouterr().err


def test_the_power_of_what_was_switched_just_now_is_recorded_after_the_next_tick(home):
    """Processes continue less than a tick after each other, too, before a command is executed."""
    site = Site(home, 7, placed=False)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23))
    recorder = Recorder(site, household)
    recorder.start()
    household.run(1.0)
    assert household.do('anna', 'appliance', 'livingroom_tv0', 'On')
    recorder.heard()
    household.run(2.0)
    times, watts = zip(*recorder.recording.power['appliance/livingroom_tv0'])
    assert times[-1] == pytest.approx(1.0, abs=0.01) and watts[-1] > 5.0


def test_who_is_pushed_moves_then_and_not_at_each_later_event(home):
    """Anna stands, is moved by 6 cm, and stands again."""
    site = Site(home, 7, placed=False)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23))
    anna = make(household, [('anna', read('worker'))])[0]
    household._queue.clear()
    recorder = Recorder(site, household)
    recorder.start()
    anna.enter(household.places.anywhere())
    household.run(10.0)
    body = site.simulator.body('anna')
    site.simulator.fidget('anna', body._replace(x=body.x + 0.06))
    household.run(11.0)
    household.run(60.0)
    assert [move.resident for move in recorder.recording.moves if move.time > 9.0] == ['anna']
    assert recorder.recording.moves[-1].time == pytest.approx(11.0)
    assert not recorder._moves(anna, household.now)
    assert anna.at[0] == pytest.approx(body.x + 0.06, abs=0.01)


def job(folder: Path, **more) -> Job:
    return Job(str(folder), 'home', 7, 1, ('2',), ('casas',), **more)


def test_homes_differ_by_seed_and_are_the_same_again(tmp_path):
    made = jobs(job(tmp_path), 5)
    assert made == jobs(job(tmp_path), 5)
    assert len({j.seed for j in made}) == 5 and made[0].name == 'home_00001'


def test_what_is_finished_and_whole_is_not_made_again(tmp_path, capsys):
    one = job(tmp_path)
    assert finished(one) is None
    entry = {'name': 'home', 'version': angen.__version__, 'settings': one.settings, 'files': {}}
    (tmp_path / 'home.json').write_text(json.dumps(entry))
    assert finished(one) == entry
    assert capsys.readouterr().err == ''
    for change, why in (({'version': '0.0.1'}, 'was made by another version of Angen'),
                        ({'files': {'events.csv.gz': 64 * '0'}}, 'events.csv.gz was changed'),
                        ({'files': {'casas.txt': 64 * '0'}}, 'casas.txt is missing')):
        (tmp_path / 'events.csv.gz').write_bytes(b'')
        (tmp_path / 'home.json').write_text(json.dumps({**entry, **change}))
        assert finished(one) is None
        assert f'{tmp_path}: {why}; the home is made again' in capsys.readouterr().err
    with pytest.raises(Failure, match='was made with other settings'):
        finished(job(tmp_path, light=True))
    (tmp_path / 'home.json').write_text('{"name": ')  # torn
    assert finished(one) is None


def test_what_cannot_be_is_said_before_any_work(tmp_path):
    with pytest.raises(Failure, match='aras has 2 residents, not 3'):
        check(Job(str(tmp_path), 'home', 1, 1, ('3',), ('aras',)))
    with pytest.raises(Failure, match="there is no profile 'retird'; did you mean"):
        check(Job(str(tmp_path), 'home', 1, 1, ('retird',), ('casas',)))


def test_a_detection_is_of_the_one_whom_the_zones_met(home):
    """Anna moves in the kitchen, Bert walks by, in sight of its sensor through the door."""
    site = Site(home, 7)
    household = Household(site.simulator, site.floors, 5, 'home', datetime.date(2026, 3, 23))
    recorder = Recorder(site, household)
    area = next(sensor for sensor in site.sensors if sensor.name == 'area_kitchen0')
    door = next(door for door in site.home.doors if door.name == 'kitchen0')
    household.residents = [SimpleNamespace(
        name=name, number=number, at=at, storey=0, away=False, room=room, walks=name == 'bert',
        posture='sit', moved=moved, item=SimpleNamespace(activity='cook'))
        for number, (name, at, room, moved) in enumerate([
            ('anna', (area.x, area.y), area.room, 59.0), ('bert', door.pose[:2], '', 0.0),
            ('cara', (area.x, area.y), area.room, 0.0)])]
    for met, whose in (('bert', 'bert'), ('anna', 'anna'), ('', 'anna'), ('cara', 'anna')):
        recorder._note(60.0, area, 'motion', f'signal 312 uV, {met}')
        assert recorder.recording.events[-1].resident == whose
    assert recorder._to_room(SimpleNamespace(at=(door.pose[0], door.pose[1] + 0.5)),
                             'kitchen0') == pytest.approx(0.5)


def test_a_cell_belongs_to_who_is_in_it_and_not_to_who_walks_out_of_the_room(home):
    """Anna stands at the fridge, whose front moves; Bert walks away."""
    site = Site(home, 7)
    household = Household(site.simulator, site.floors, 5, 'home', datetime.date(2026, 3, 23))
    recorder = Recorder(site, household)
    cell = next(sensor for sensor in site.sensors if sensor.name.startswith('cell_kitchen'))

    def cause(**away: float) -> str:
        household.residents = [SimpleNamespace(
            name=name, number=number, at=(cell.x + away[name], cell.y), storey=0, away=False,
            room=cell.room, walks=name == 'bert', posture='sit', moved=-math.inf,
            item=SimpleNamespace(activity='cook')) for number, name in enumerate(away)]
        return recorder._cause(60.0, cell, 'anna')[0]

    assert cause(anna=0.1, bert=1.8) == 'anna'
    assert cause(anna=0.1, bert=1.2) == 'bert'
    assert cause(anna=1.6, bert=1.8) == 'bert'
