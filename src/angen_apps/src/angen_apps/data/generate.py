"""Makes homes' data: one after the other, on several processes, or on a cluster."""
from __future__ import annotations

import csv
import datetime
import hashlib
import json
import multiprocessing
import os
import shutil
import sys
import tempfile
import time
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import asdict, dataclass, replace
from itertools import chain
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator

from angen_apps.data import faults, run, site
from angen_apps.data.formats import FORMATS
from angen_apps.data.formats.periods import zipped
from angen_apps.data.formats.table import pyarrow
from angen_apps.data.part_folder import MARKER, part_folder
from angen_apps.data.tables import ENTRY, parsed
from angen_apps.residents import truth
from angen_apps.residents.chance import chance
from angen_apps.residents.profiles import is_file, names
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.files import check_folder, make_folder, write_csv, write_text
from angen_tools.common.home import Home
from angen_tools.common.output import with_each
from angen_tools.common.progress import Progress

MANIFEST, HOME = 'manifest.json', 'home.json'
LOADS = 'loads.csv.gz'  # W of each lamp and appliance from a time on
MOVES = 'moves.csv.gz'  # when those who stay at a place moved
CABINS = 'cabins.csv.gz'  # places of the links of elevators from a time on
TALKS = 'talks.csv.gz'  # who speaks to whom
TRUTH = ('truth.csv.gz', 'missed.csv', 'faults.csv', 'layout.json', 'track.csv.gz', LOADS, MOVES)
AGAIN = 5  # times that the pool is made again after its processes died
MIXED = ('worker', 'retired', 'student', 'night_shift_worker', 'elder_with_dementia')


@dataclass(frozen=True)
class Job:
    """One home. All but `folder` and `strict` decides about its bytes."""

    folder: str
    name: str
    seed: int
    days: int
    residents: tuple[str, ...]
    formats: tuple[str, ...]
    start: str = ''
    world: str = ''
    faults: str = ''
    light: bool = False
    own_sensors: bool = False
    strict: bool = False

    @property
    def settings(self) -> dict[str, Any]:
        found = asdict(self)
        del found['folder'], found['strict']
        for key in ('world', 'faults'):  # the files' contents count, not their paths
            if found[key]:
                found[key] = sha256(Path(found[key]))
        found['residents'] = [sha256(Path(word)) if is_file(word) else word
                              for word in self.residents]
        return {key: list(value) if isinstance(value, tuple) else value
                for key, value in found.items()}

    def absolute(self) -> Job:
        """The same, for a process in another folder."""
        def full(path: str) -> str:
            return str(Path(path).resolve()) if path else ''
        return replace(self, folder=full(self.folder), world=full(self.world),
                       faults=full(self.faults), residents=tuple(
                           full(word) if is_file(word) else word for word in self.residents))


def jobs(job: Job, homes: int) -> list[Job]:
    """The jobs of `homes` homes, which differ by seed and, if only a number of residents is
    given, in who lives there."""
    if homes == 1:
        return [job]
    found = []
    for i in range(1, homes + 1):
        numbers = chance(job.seed, 'home', i)
        residents = job.residents
        if len(residents) == 1 and residents[0].isdigit():
            count = numbers.randint(1, int(residents[0]))
            residents = tuple(numbers.choice(MIXED) for _ in range(count))
        name = f'home_{i:05d}'
        found.append(replace(job, folder=str(Path(job.folder) / name), name=name,
                             seed=numbers.getrandbits(31), residents=residents))
    return found


def check(job: Job) -> None:
    """Raises Failure for invalid settings, before any work."""
    check_folder(Path(job.folder))
    who = run.residents_of(list(job.residents))
    if not who:
        raise Failure('--residents names no resident; give a number or profiles of '
                      + ', '.join(names()))
    if 'aras' in job.formats and len(who) > 2:
        raise Failure(f'aras has 2 residents, not {len(who)}; leave aras out of --format')
    if 'parquet' in job.formats:
        pyarrow()
    if job.faults:
        faults.read(Path(job.faults))


def make(job: Job, progress: Callable[[float], None] = lambda _: None) -> dict[str, Any]:
    """Makes a home's files in its folder, which gets its name when it is complete; returns its
    entry of the manifest."""
    folder = Path(job.folder)
    made = finished(job)
    if made is not None:
        return made
    with part_folder(folder) as part:
        data = _live(job, progress)
        paths = [path for name in dict.fromkeys((*job.formats, 'csv'))
                 for path in FORMATS[name](part, data)]
        paths += write_truth(part, data)
        entry = {
            'name': job.name, 'version': angen_module().__version__, 'settings': job.settings,
            'residents': [[name, profile.name] for name, profile in data.residents],
            'sensors': len(data.sensors),
            'events': len(data.events), 'missed': len(data.missed), 'faults': len(data.faults),
            'files': {str(path.relative_to(part)): sha256(path) for path in sorted(paths)}}
        write_text(part / HOME, json.dumps(entry, indent=1, sort_keys=True) + '\n')
        _put(part, folder)
    return entry


def _put(part: Path, folder: Path) -> None:
    """Gives the finished files their names: the last of them is home.json."""
    (part / MARKER).unlink()
    if not folder.exists():
        os.replace(part, folder)
        return
    for path in sorted(part.rglob('*'), key=lambda p: (p.name == HOME, p)):
        if path.is_file():
            target = folder / path.relative_to(part)
            make_folder(target.parent)
            os.replace(path, target)
    shutil.rmtree(part)


def _live(job: Job, progress: Callable[[float], None]) -> run.Data:
    start = datetime.date.fromisoformat(job.start) if job.start else None
    with tempfile.TemporaryDirectory(prefix='angen_') as scratch:
        world = Path(job.world) if job.world else Path(scratch) / 'home.world'
        if not job.world:
            site.apartment(world)
        return run.live(world, job.name, job.days, run.residents_of(list(job.residents)), job.seed,
                        start, not job.own_sensors, job.light,
                        faults.read(Path(job.faults)) if job.faults else [], progress, job.strict)


def finished(job: Job) -> dict[str, Any] | None:
    """The manifest's entry of a complete home, whose files have the hashes noted there; a home that
    differs is reported and has none. Failure if the folder contains another home."""
    path = Path(job.folder) / HOME
    if not path.is_file():
        return None
    try:
        entry: dict[str, Any] = parsed(path, ENTRY)
    except Failure:
        return None
    settings, files = entry['settings'], entry['files']
    if settings != job.settings:
        raise Failure(f'{path}: was made with other settings; give another folder with --out')
    if why := _difference(Path(job.folder), entry.get('version'), files):
        print(f'angen: {job.folder}: {why}; the home is made again', file=sys.stderr, flush=True)
        return None
    return entry


def _difference(folder: Path, version: Any, files: dict[str, str]) -> str:
    """What of a home is not as its entry says; empty if all is."""
    if version != angen_module().__version__:
        return 'was made by another version of Angen'
    for name, digest in sorted(files.items()):
        path = folder / name
        if not path.is_file():
            return f'{name} is missing'
        if sha256(path) != digest:
            return f'{name} was changed'
    return ''


def write_truth(folder: Path, data: run.Data) -> list[Path]:
    """The files of TRUTH, and those of elevators and talks if there are any."""
    paths = [folder / name for name in TRUTH]
    with zipped(paths[0]) as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(truth.HEAD)
        writer.writerows(interval.row() for interval in data.truth)
    write_csv(paths[1], ('start', 'end', 'sensor', 'resident'),
              [(f'{m.start:.3f}', f'{m.end:.3f}', m.sensor, m.resident) for m in data.missed])
    write_csv(paths[2], faults.Happened._fields, data.faults)
    layout = {
        'start': data.start.isoformat(), 'days': data.days,
        'residents': [{'name': name, 'profile': profile.name, 'body': profile.body,
                       'speed': profile.speed} for name, profile in data.residents],
        'guests': [{'name': name, 'host': host} for name, host in data.guests],
        **described(data.home, data.sensors)}
    _write_table(paths[4], 'time,resident,x,y,storey', (
        f'{t:.3f},{who},{x:.3f},{y:.3f},{storey}' for t, who, x, y, storey in data.track))
    _write_table(paths[5], 'time,kind,device,watts', (
        f'{time:.3f},{device.replace("/", ",", 1)},{watts:.3f}' for time, device, watts in sorted(
            (time, device, watts) for device, line in data.power.items() for time, watts in line)))
    _write_table(paths[6], 'time,resident', (
        f'{move.time:.3f},{move.resident}' for move in data.moves))
    if data.slides:
        paths.append(folder / CABINS)
        _write_table(paths[-1], 'time,model,link,x,y,z', (
            f'{t:.3f},{model},{link},{x:.4f},{y:.4f},{z:.4f}'
            for t, model, link, x, y, z in data.slides))
    if data.talks:
        paths.append(folder / TALKS)
        _write_table(paths[-1], 'start,end,resident,to', (
            f'{talk.start:.3f},{talk.end:.3f},{talk.resident},{talk.to}' for talk in data.talks))
    write_text(paths[3], json.dumps(with_each(layout, _rounded), indent=1) + '\n')
    return paths


def described(home: Home, sensors: list[site.Sensor]) -> dict[str, Any]:
    """The part of a layout that is of the world."""
    found: dict[str, Any] = with_each({
        'rooms': [{'name': r.name, 'use': r.use, 'storey': r.storey,
                   'polygon': r.polygon, 'holes': r.holes, 'area': r.area}
                  for r in home.rooms],
        'doors': [{'name': d.name, 'kind': d.kind, 'rooms': list(d.rooms), 'pose': list(d.pose),
                   'width': d.width} for d in home.doors],
        'landings': [{'elevator': elevator.name, 'storey': landing.storey,
                      'pose': list(landing.pose)}
                     for elevator in home.elevators for landing in elevator.landings],
        'things': [{'name': t.name, 'type': t.type, 'room': t.room, 'x': t.pose[0], 'y': t.pose[1]}
                   for t in home.things],
        'sensors': [{key: value for key, value in asdict(s).items() if key != 'source'}
                    for s in sensors]}, _rounded)
    return found


def _rounded(value: Any) -> Any:
    return round(value, 4) if isinstance(value, float) else value


def _write_table(path: Path, head: str, rows: Iterable[str]) -> None:
    with zipped(path) as file:
        file.writelines(f'{row}\n' for row in chain([head], rows))


def sha256(path: Path) -> str:
    """The hash of a file."""
    with path.open('rb') as file:
        return hashlib.file_digest(file, 'sha256').hexdigest()


def generate(job: Job, homes: int, processes: int, scheduler: str = '') -> list[dict[str, Any]]:
    """Makes all homes and their manifest; returns the entry of each home."""
    check(job)
    todo = jobs(job, homes)
    made: dict[str, dict[str, Any]] = {}
    begun = time.monotonic()
    with Progress('generate', 0.1) as progress:
        if homes == 1 and not scheduler:
            made[job.name] = make(job, lambda share: progress.update(share, _left(share, begun)))
        else:
            results = _on_cluster(todo, scheduler) if scheduler else _on_processes(todo, processes)
            for entry in results:
                made[entry['name']] = entry
                share = len(made) / len(todo)
                progress.update(share, f'{len(made)} of {len(todo)} homes, {_left(share, begun)}')
    entries = [made[name] for name in sorted(made)]
    write_text(Path(job.folder) / MANIFEST, json.dumps({
        'format': 1, 'seed': job.seed, 'homes': entries}, indent=1, sort_keys=True) + '\n')
    return entries


def _left(share: float, begun: float) -> str:
    seconds = (time.monotonic() - begun) * max(0.0, 1 - share) / max(share, 1e-6)
    for unit, size in (('h', 3600), ('min', 60)):
        if seconds > 1.5 * size:
            return f'{seconds / size:.0f} {unit} left'
    return f'{seconds:.0f} s left'


def _on_processes(todo: list[Job], processes: int) -> Iterator[dict[str, Any]]:
    """Yields results as they arrive; makes the unfinished homes of a killed process again."""
    waiting = {job.name: job for job in todo}
    for attempt in range(AGAIN):
        context = multiprocessing.get_context('spawn')
        with ProcessPoolExecutor(processes, context) as pool:
            running = {pool.submit(make, job): name for name, job in sorted(waiting.items())}
            try:
                while running:
                    done, _ = wait(running, return_when=FIRST_COMPLETED)
                    for future in done:
                        name = running.pop(future)
                        entry = future.result()
                        del waiting[name]
                        yield entry
                return
            except BrokenProcessPool:
                if attempt + 1 == AGAIN:
                    raise Failure(f'processes died {AGAIN} times; is there enough memory?'
                                  ) from None


def _on_cluster(todo: list[Job], scheduler: str) -> Iterator[dict[str, Any]]:
    """Results of a Dask cluster, whose workers share this folder."""
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise Failure('--scheduler needs Dask; install python3-distributed') from None
    try:
        client = Client(scheduler, timeout=10)
    except (OSError, ValueError, TimeoutError) as error:
        raise Failure(f'no scheduler at {scheduler}: {error}') from None
    with client:
        futures = [client.submit(make, job.absolute(), key=f'angen-{job.name}-{job.seed}',
                                 pure=False, retries=3) for job in todo]
        for _, entry in as_completed(futures, with_results=True):
            yield entry
