"""Homes by one process, by two of which one dies, and by a cluster one of whose workers dies: the
same bytes. A carer visits each for some minutes, and no one else lives there; few sensors."""
from __future__ import annotations

import json
import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, Iterator

import pytest

from angen_apps.data.generate import MANIFEST, Job, generate, make
from angen_apps.data.part_folder import MARKER
from angen_apps.data.site import apartment
from angen_apps.data.tables import homes
from angen_apps.data.validate import validate
from angen_tools.common.failure import Failure

SCRIPT = Path(__file__).resolve().parents[3] / 'src/angen_tools/scripts/angen'
HOMES = 2
BRIEF = """
speed: 1.15
lives: false
wakes: '5:30-6:00'
sleeps: '22:00-22:30'
scheduled:
  - {do: [care, clean], at: '8:00-8:10'}
"""
STARTS = 60.0  # s of wall time, at most, until a worker is there


def job(folder: Path, world: Path) -> Job:
    carer = world.parent / 'brief.yaml'
    carer.write_text(BRIEF)
    return Job(str(folder), 'home', 11, 1, (str(carer),),
               ('casas', 'openshs', 'aras', 'csv', 'xes'),
               world=str(world), own_sensors=True)


def hashes(folder: Path) -> dict[str, Any]:
    """The hash of each file, by home."""
    manifest = json.loads((folder / MANIFEST).read_text())
    return {home['name']: home['files'] for home in manifest['homes']}


@pytest.fixture(scope='module')
def world(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp('world') / 'home.world'
    apartment(path)
    return path


@pytest.fixture(scope='module')
def made(tmp_path_factory, world) -> Path:
    """Homes by one process of the command."""
    folder = tmp_path_factory.mktemp('made')
    given = job(folder, world)
    subprocess.run([sys.executable, str(SCRIPT), 'generate', '--homes', str(HOMES), '--days', '1',
                    '--residents', *given.residents, '--seed', str(given.seed), '--processes',
                    '1', '--format', ','.join(given.formats), str(world),
                    '--own-sensors', '--out', str(folder)], check=True)
    return folder


def kill_soon(folder: Path, victims: Callable[[], list[int]]) -> threading.Thread:
    """Kills one of the processes once a home is begun."""
    def run() -> None:
        end = time.monotonic() + STARTS
        while time.monotonic() < end:
            pids = victims()
            if pids and any(folder.glob('*.part')):
                os.kill(pids[0], signal.SIGKILL)
                return
            time.sleep(0.1)
    thread = threading.Thread(target=run)
    thread.start()
    return thread


def test_each_home_is_valid(made):
    for home in homes(made):
        findings = validate(home)
        assert findings.wrong and findings.count == 0, findings.wrong
        assert findings.checked['no resident crossed a wall'] >= 5
        assert findings.checked['no speed above their own'] >= 100


def test_a_profile_of_ones_own_lives_and_counts_by_its_contents(world, tmp_path):
    own = tmp_path / 'painter.yaml'
    own.write_text(BRIEF)
    given = replace(job(tmp_path / 'home', world), residents=(str(own),), formats=('csv',))
    entry = make(given)
    assert entry['residents'] == [['anna', 'painter']]
    layout = json.loads((tmp_path / 'home/layout.json').read_text())
    assert [(r['profile'], r['body']) for r in layout['residents']] == [('painter', 'person')]
    assert make(given) == entry
    own.write_text(own.read_text().replace('speed: ', 'speed: 0'))
    with pytest.raises(Failure, match='made with other settings'):
        make(given)


def test_two_processes_of_which_one_dies_make_the_same_bytes(made, world, tmp_path):
    killer = kill_soon(tmp_path, lambda: [p.pid for p in multiprocessing.active_children()
                                          if p.pid is not None])
    generate(job(tmp_path, world), HOMES, 2)
    killer.join()
    assert hashes(tmp_path) == hashes(made)


def test_a_torn_home_is_made_again_and_a_finished_one_is_not(made, world, tmp_path):
    folder = tmp_path / 'again'
    shutil.copytree(made, folder)
    (folder / MANIFEST).unlink()
    torn, kept = folder / 'home_00001', folder / 'home_00002'
    torn.rename(folder / 'home_00001.part')
    (folder / 'home_00001.part' / 'events.csv.gz').write_bytes(b'torn')
    with pytest.raises(Failure, match=r'home_00001.part: was not made by angen generate; move it'):
        generate(job(folder, world), HOMES, 1)
    (folder / 'home_00001.part' / MARKER).touch()
    before = (kept / 'home.json').stat().st_mtime_ns
    generate(job(folder, world), HOMES, 1)
    assert hashes(folder) == hashes(made)
    assert (kept / 'home.json').stat().st_mtime_ns == before
    assert not list(folder.glob('*.part'))


@pytest.fixture
def cluster(tmp_path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler's address, and its two workers."""
    where = tmp_path / 'scheduler.json'
    log = (tmp_path / 'dask.log').open('wb')
    elsewhere = tmp_path / 'elsewhere'
    elsewhere.mkdir()

    def start(*args: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen([sys.executable, '-m', 'distributed.cli.' + args[0], *args[1:]],
                                cwd=elsewhere, stdout=log, stderr=log)

    running = [start('dask_scheduler', '--host', '127.0.0.1', '--port', '0', '--no-dashboard',
                     '--scheduler-file', str(where))]
    try:
        end = time.monotonic() + STARTS
        while not where.is_file() and time.monotonic() < end:
            time.sleep(0.2)
        running += [start('dask_worker', '--scheduler-file', str(where), '--nthreads', '1',
                          '--no-nanny', '--no-dashboard', '--host', '127.0.0.1',
                          '--local-directory', str(tmp_path / f'w{i}')) for i in range(2)]
        yield json.loads(where.read_text())['address'], running[1:]
    finally:
        for process in running[::-1]:
            process.terminate()
            process.wait()
        log.close()


def test_a_cluster_of_which_a_worker_dies_makes_the_same_bytes(made, world, cluster, tmp_path,
                                                               monkeypatch):
    """Its workers are in another folder than the command."""
    address, workers = cluster
    monkeypatch.chdir(tmp_path)
    folder, world = Path('out'), Path(os.path.relpath(world))
    killer = kill_soon(folder, lambda: [workers[0].pid])
    generate(job(folder, world), HOMES, 1, address)
    killer.join()
    assert workers[0].poll() is not None
    assert hashes(folder) == hashes(made)


def test_a_missing_scheduler_is_reported(world, tmp_path):
    with pytest.raises(Failure, match='no scheduler at tcp://127.0.0.1:9'):
        generate(job(tmp_path, world), 1, 1, 'tcp://127.0.0.1:9')
