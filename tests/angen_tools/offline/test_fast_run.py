"""angen run --fast: a world without ROS."""
import csv
import gzip
import random
import resource
import signal
import subprocess
import sys
import time
import zlib
from pathlib import Path
from typing import Any

import angen
import pytest

from angen_tools.offline import events, fast_run

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'
WORLD = '''<sdf version="1.6"><world name="w">
  <include><uri>model://pir</uri><name>eye</name><pose>0 0 1.5 0 0 0</pose></include>
  <actor name="ann"><script><loop>true</loop><trajectory id="0" type="walk">
    <waypoint><time>0</time><pose>2 -3 0 0 0 1.57</pose></waypoint>
    <waypoint><time>40</time><pose>2 -3 0 0 0 1.57</pose></waypoint>
    <waypoint><time>44</time><pose>2 3 0 0 0 1.57</pose></waypoint>
    <waypoint><time>60</time><pose>2 3 0 0 0 1.57</pose></waypoint></trajectory></script></actor>
  <model name="ground"><static>true</static><link name="link"><collision name="c"><geometry><plane>
    <normal>0 0 1</normal></plane></geometry></collision></link></model>
</world></sdf>
'''


@pytest.fixture
def world(tmp_path: Path) -> Path:
    path = tmp_path / 'walk.world'
    path.write_text(WORLD)
    return path


def run(*words: object, **options: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), 'run', '--fast', *map(str, words)],
                          text=True, capture_output=True, timeout=120, **options)


def test_it_leaves_the_events_that_all_ticks_would_tell(world: Path, tmp_path: Path) -> None:
    done = run(world, '--for', '55.5s', '--seed', '3', '--out', tmp_path / 'out')
    assert (done.returncode, done.stderr) == (0, '')
    with (tmp_path / 'out/events.csv').open() as file:
        rows = list(csv.reader(file))
    walked = angen.World(str(world), seed=3)
    walked.step(55500)
    expected = walked.events()
    assert rows[0] == ['time', 'source', 'kind', 'event', 'detail', 'quantity', 'value', 'unit']
    assert [(float(row[0]), *row[1:5]) for row in rows[1:]] == expected
    moved = next(row for row in rows if row[3] == 'motion')  # "difference 0.11 m"
    assert moved[5:] == moved[4].split() and moved[5] == 'difference' and moved[7] == 'm'
    assert '0.3' == events.seconds(0.1 + 0.2) and '86400' == events.seconds(86400.0)
    assert {'motion'} <= {row[3] for row in rows[1:] if row[1] == 'eye'}
    assert done.stdout.startswith('55.5 s in ')
    assert f'{walked.readings} readings, {len(expected)} events in {tmp_path}' in done.stdout


@pytest.fixture(scope='module')
def whole(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """The lines of events of a run that nobody kills."""
    folder = tmp_path_factory.mktemp('whole')
    (folder / 'walk.world').write_text(WORLD)
    assert run(folder / 'walk.world', '--for', '3000', '--out', folder).returncode == 0
    return (folder / 'events.csv').read_text().splitlines()


def test_what_a_file_lacks_is_told(tmp_path: Path) -> None:
    path = tmp_path / 'w.world'
    mesh = '<geometry><mesh><uri>model://x/%s</uri></mesh></geometry>'
    path.write_text('<sdf version="1.4"><world name="w">' + ''.join(
        f'<model name="{name}"><link name="l"><collision name="c">{mesh % name}</collision>'
        f'<visual name="v">{mesh % name}</visual></link></model>'
        for name in ('a.dae', 'b.stl')) + '</world></sdf>')
    done = run(path, '--for', '1', '--out', tmp_path / 'out')
    assert done.returncode == 0
    assert done.stderr.startswith(f'warning: {path}:1: mesh ')
    assert 'model://x/a.dae' in done.stderr and 'model://x/b.stl' in done.stderr


@pytest.mark.parametrize('seed', range(4))
def test_a_kill_leaves_the_events_until_then(world: Path, tmp_path: Path, seed: int,
                                             whole: list[str]) -> None:
    log, part = tmp_path / 'events.csv', tmp_path / 'events.csv.part'
    log.write_text('of the last run')
    process = subprocess.Popen([sys.executable, str(SCRIPT), 'run', '--fast', str(world), '--for',
                                '1e9', '--out', str(tmp_path)], stderr=subprocess.DEVNULL)
    enough = random.Random(seed).randrange(100, 5000)
    while not part.exists() or part.stat().st_size < enough:
        assert process.poll() is None
    process.kill()
    process.wait()
    assert log.read_text() == 'of the last run'
    written = part.read_text().splitlines()[:-1]  # the last line may be cut
    assert len(written) > 1 and written[:len(whole)] == whole[:len(written)]
    assert run(world, '--for', '1', '--out', tmp_path).returncode == 0 and not part.exists()


def test_a_full_disk_leaves_whole_lines(world: Path, tmp_path: Path) -> None:
    done = run(world, '--for', '1e9', '--out', tmp_path, preexec_fn=lambda: resource.setrlimit(
        resource.RLIMIT_FSIZE, (3000, 3000)))
    assert (done.returncode, done.stdout) == (1, '')
    line, = done.stderr.splitlines()
    assert line == (f'angen: {tmp_path}/events.csv: cannot be written: File too large; the lines '
                    f'written before are in {tmp_path}/events.csv.part')
    assert [path.name for path in tmp_path.glob('events*')] == ['events.csv.part']
    with (tmp_path / 'events.csv.part').open() as file:
        assert {len(row) for row in csv.reader(file)} == {8}


@pytest.mark.parametrize('detail, value', [
    ('difference 0.11 m', ('difference', '0.11', 'm')),
    ('magnet at 0.02 m', ('magnet', '0.02', 'm')),
    ('from 0 to 130 lx', ('', '130', 'lx')), ('floor 1', ('floor', '1', '')),
    ('-120 g', ('', '-120', 'g')), ('3 ml, 1 ml run through', ('', '3', 'ml')),
    ('by bath_door0::leaf', ('', '', '')), ('', ('', '', '')), ('false alarm', ('', '', ''))])
def test_the_value_of_an_event_has_columns_of_its_own(detail: str, value: tuple[str, ...]) -> None:
    assert tuple(part or '' for part in events.row(1.0, 'a', 'pir', 'motion', detail)[5:]) == value


FLAT = WORLD.replace('</world>', '''
  <include><uri>model://luminosity_sensor</uri><name>kitchen_lux0</name>
    <pose>1 1 2 0 0 0</pose></include>
  <plugin name="doors" filename="libdoor_world_plugin.so"/>
  <include><uri>model://bath_door0</uri></include>
  <include><uri>model://stove</uri><name>kitchen_stove0</name><pose>-3 0 0 0 0 0</pose></include>
</world>''')


def table(path: Path) -> list[dict[str, str]]:
    with gzip.open(path, 'rt', newline='') as file:
        return list(csv.DictReader(file))


def test_readings_are_those_that_each_tick_would_publish(tmp_path: Path) -> None:
    """Also of the time that was leapt over; the noise of each sample is its own."""
    path, readings = tmp_path / 'flat.world', tmp_path / 'r.csv.gz'
    path.write_text(FLAT)
    day = tmp_path / 'day.csv'
    day.write_text('time,target,command\n0:00:12,door/bathroom0,Open\n0:00:20,stove/all,Off\n')
    done = run(path, '--for', '30', '--day', day, '--readings', readings, '--out', tmp_path)
    assert (done.returncode, done.stderr) == (0, '')
    with (tmp_path / 'events.csv').open() as file:
        assert {('12', 'bathroom0', 'opening')} <= {
            (row['time'], row['source'], row['event']) for row in csv.DictReader(file)}
    walked = angen.World(str(path), seed=1)
    expected = []
    for tick in range(1, 30001):
        if tick - 1 == 12000:
            walked.command('door', 'bathroom0', 'Open')
        walked.step()
        for kind, name, every in (('pir', 'eye', 100), ('luminosity', 'kitchen_lux0', 1000)):
            if tick % every == 0 or tick == 1:
                reading = walked.sensor(kind, name)
                if reading['stamp'] == walked.time:
                    expected += [(round(walked.time, 6), name, field, float(value))
                                 for field, value in reading.items()
                                 if isinstance(value, (bool, int, float)) and field != 'stamp']
    found = [(float(row['time']), row['name'], row['field'], float(row['value']))
             for row in table(readings) if row['name'] in ('eye', 'kitchen_lux0') and row['value']]
    assert {row[1] for row in expected} == {'eye', 'kitchen_lux0'} and len(expected) > 600
    assert sorted(found) == [
        (time, name, field, pytest.approx(value, rel=1e-8))
        for time, name, field, value in sorted(expected)]
    units = {(row['field'], row['unit']) for row in table(readings)}
    assert ('illuminance', 'lx') in units


def test_pandas_reads_the_readings_with_types(tmp_path: Path) -> None:
    import pandas
    path, readings = tmp_path / 'flat.world', tmp_path / 'r.csv.gz'
    path.write_text(FLAT)
    assert run(path, '--for', '50', '--readings', readings, '--out', tmp_path).returncode == 0
    day, rows = pandas.read_csv(readings), table(readings)
    assert len(day) == len(rows) > 1000
    assert [str(day[name].dtype) for name in ('time', 'value', 'name')] == [
        'float64', 'float64', 'object']
    motion = day[(day.name == 'eye') & (day.field == 'motion')].set_index('time').value
    assert list(motion) == [float(row['value']) for row in rows
                            if row['name'] == 'eye' and row['field'] == 'motion']
    assert motion[:39].max() == 0 and motion[40:45].max() == 1  # she walks by from 40 to 44 s


def test_ctrl_c_reports_the_kept_files(world: Path, tmp_path: Path) -> None:
    readings = tmp_path / 'r.csv.gz'
    process = subprocess.Popen(
        [sys.executable, str(SCRIPT), 'run', '--fast', str(world), '--for', '100d', '--readings',
         str(readings), '--out', str(tmp_path)], stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    part = tmp_path / 'r.csv.gz.part'
    while not part.exists() or part.stat().st_size < 3000:
        assert process.poll() is None
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=60)[1].splitlines()[-1]
    assert process.returncode == 130 and said.endswith(
        f'what happened until then is in {tmp_path}/events.csv and {readings}')
    rows = table(readings)
    assert rows and set(rows[0]) == {'time', 'kind', 'name', 'field', 'value', 'unit', 'text'}


@pytest.mark.parametrize('write', [0, 1])
def test_ctrl_c_within_a_write_damages_no_file(write: int, world: Path, tmp_path: Path,
                                               monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gzip, 'zlib', Interrupting(write))
    readings = tmp_path / 'r.csv.gz'
    with pytest.raises(KeyboardInterrupt):
        fast_run.run(str(world), 60.0, 1, tmp_path, readings=readings)
    monkeypatch.undo()
    assert bool(table(readings)) == bool(write)


class Interrupting:
    """The module zlib, of which one sum over written data is interrupted by Ctrl-C."""

    def __init__(self, write: int) -> None:
        self._left = write

    def __getattr__(self, name: str) -> Any:
        return getattr(zlib, name)

    def crc32(self, data: bytes, *before: int) -> int:
        self._left -= bool(data)
        if data and self._left == -1:
            signal.raise_signal(signal.SIGINT)
        return zlib.crc32(data, *before)
