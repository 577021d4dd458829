"""angen run --fast: a world without ROS."""
from __future__ import annotations

import csv
import random
import resource
import subprocess
import sys
from pathlib import Path
from typing import Any

import angen
import pytest

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
    done = run(world, '--for', '55.5', '--seed', '3', '-o', tmp_path / 'out')
    assert (done.returncode, done.stderr) == (0, '')
    with (tmp_path / 'out/events.csv').open() as file:
        rows = list(csv.reader(file))
    walked = angen.World(str(world), seed=3)
    walked.step(55500)
    expected = walked.events()
    assert rows[0] == ['time', 'source', 'kind', 'event', 'detail']
    assert rows[1:] == [[f'{at:.6f}', *what] for at, *what in expected]
    assert {'motion'} <= {row[3] for row in rows[1:] if row[1] == 'eye'}
    assert done.stdout.startswith('55.5 s in ')
    assert f'{walked.readings} readings, {len(expected)} events in {tmp_path}' in done.stdout


def test_what_is_wrong_is_told_in_a_line(world: Path, tmp_path: Path) -> None:
    world.write_text(WORLD.replace('model://pir', 'model://no_such_model'))
    done = run(world, '--for', '1', '-o', tmp_path)
    assert done.returncode == 1 and done.stdout == ''
    line, = done.stderr.splitlines()
    assert 'walk.world:2: ' in line and 'no_such_model' in line


def test_a_place_that_cannot_be_written_is_named(world: Path) -> None:
    done = run(world, '--for', '1', '-o', '/dev/null')
    assert done.returncode == 1 and done.stderr.count('\n') == 1
    assert '/dev/null' in done.stderr


@pytest.mark.parametrize('words', [['--for', '0'], ['--for', 'soon'], ['--for', 'inf'], []])
def test_a_time_is_needed(world: Path, words: list[str]) -> None:
    done = run(world, *words)
    assert done.returncode == 2 and '--for' in done.stderr


@pytest.mark.parametrize('seed', range(4))
def test_a_kill_leaves_the_events_until_then(world: Path, tmp_path: Path, seed: int) -> None:
    log, part = tmp_path / 'events.csv', tmp_path / 'events.csv.part'
    log.write_text('of the last run')
    process = subprocess.Popen([sys.executable, str(SCRIPT), 'run', '--fast', str(world), '--for',
                                '1e9', '-o', str(tmp_path)], stderr=subprocess.DEVNULL)
    enough = random.Random(seed).randrange(100, 5000)
    while not part.exists() or part.stat().st_size < enough:
        assert process.poll() is None
    process.kill()
    process.wait()
    assert log.read_text() == 'of the last run'
    written = part.read_text().splitlines()[:-1]  # the last line may be cut
    whole = run(world, '--for', '3000', '-o', tmp_path)
    assert whole.returncode == 0 and not part.exists()
    lines = log.read_text().splitlines()
    assert len(written) > 1 and written[:len(lines)] == lines[:len(written)]


def test_a_full_disk_leaves_whole_lines(world: Path, tmp_path: Path) -> None:
    done = run(world, '--for', '1e9', '-o', tmp_path, preexec_fn=lambda: resource.setrlimit(
        resource.RLIMIT_FSIZE, (3000, 3000)))
    assert (done.returncode, done.stdout) == (1, '')
    line, = done.stderr.splitlines()
    assert line == (f'angen: {tmp_path}/events.csv: cannot be written: File too large; what was '
                    f'written before is in {tmp_path}/events.csv.part')
    assert [path.name for path in tmp_path.glob('events*')] == ['events.csv.part']
    with (tmp_path / 'events.csv.part').open() as file:
        assert {len(row) for row in csv.reader(file)} == {5}
