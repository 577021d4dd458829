"""angen bench core: the cost of the core without ROS, as ratios, by google-benchmark."""
import json as jsonlib
import resource
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from angen_bench import history
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_csv
from angen_tools.common.output import as_json, show, table
from angen_tools.common.progress import Steps
from angen_tools.common.watchdog import watchdog
from angen_tools.live.sandbox import built_program
from angen_tools.world.apartment import write_apartment

PROGRAMS = ('core_bench', 'motion_bench', 'rays_bench', 'physics_bench')
COLUMNS = ('ratio', 'against', 'case', 'cpu_ns', 'counters', 'commit')

# A case, and the one that its time is divided by; both are measured in the same run.
AGAINST = {
    'doors_awake/12': 'doors_in_bare_ode/12',
    'doors_awake/120': 'doors_in_bare_ode/120',
    'BM_Ours/pir': 'BM_RawEmbree/pir',
    'BM_Ours/random': 'BM_RawEmbree/random',
    'building_in_motion': 'building_in_bare_ode',
    'storeys/floors:20/noise:0': 'storeys/floors:2/noise:0',
    'storeys/floors:100/noise:0': 'storeys/floors:2/noise:0',
    'storeys/floors:20/noise:1': 'storeys/floors:2/noise:1',
    'storeys/floors:100/noise:1': 'storeys/floors:2/noise:1',
    'doors_at_rest/doors:1000': 'doors_at_rest/doors:0',
    'people/people:10': 'people/people:1',
    'people/people:100': 'people/people:1',
    'pirs/pirs:0/people:10': 'pirs/pirs:0/people:1',
    'pirs/pirs:3000/people:1': 'pirs/pirs:0/people:1',
    'pirs/pirs:30000/people:10': 'pirs/pirs:0/people:10',
}
NOT_COUNTERS = {'name', 'family_index', 'per_family_instance_index', 'run_name', 'run_type',
                'repetitions', 'repetition_index', 'threads', 'iterations', 'real_time', 'cpu_time',
                'time_unit', 'items_per_second'}
NS = {'ns': 1.0, 'us': 1e3, 'ms': 1e6, 's': 1e9}


@dataclass(frozen=True)
class Case:
    """One benchmark: CPU time of a turn in ns, and what else it counted."""
    name: str
    cpu_ns: float
    counters: dict[str, float]


def program(name: str) -> Path:
    """The built benchmark; Failure says how to build it."""
    found = built_program(name)
    if found is None:
        raise Failure(f'{name} is not built; build the target "benches"')
    return found


def cases_of(report: str) -> list[Case]:
    """The cases of google-benchmark's JSON, without the repetition in their names."""
    cases = []
    for run in jsonlib.loads(report)['benchmarks']:
        name = run['name'].split('/iterations:')[0]
        counters = {key: value for key, value in run.items() if key not in NOT_COUNTERS}
        cases.append(Case(name, run['cpu_time'] * NS[run['time_unit']], counters))
    return cases


def start_cases() -> list[Case]:
    """The time of a process that loads apartments with 200 PIRs and takes a tick; the median of
    five.
    """
    program = 'import sys, angen; angen.World(sys.argv[1]).step(1)'
    times = []
    with tempfile.TemporaryDirectory() as folder:
        world = Path(folder) / 'floors.world'
        write_apartment(world, 2, {'pir': 200}, 1)
        for _ in range(5):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([sys.executable, '-c', program, str(world)], check=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return [Case('start', sorted(times)[2] * 1e9, {})]


def rows_of(cases: list[Case], commit: str) -> list[dict[str, str]]:
    """CSV rows, those with a ratio first."""
    times = {case.name: case.cpu_ns for case in cases}
    rows = []
    for case in cases:
        against = AGAINST.get(case.name, '')
        ratio = f'{case.cpu_ns / times[against]:.3g}' if times.get(against) else ''
        counters = ' '.join(f'{key}={value:.4g}' for key, value in case.counters.items())
        rows.append({'ratio': ratio, 'against': against if ratio else '', 'case': case.name,
                     'cpu_ns': f'{case.cpu_ns:.4g}', 'counters': counters, 'commit': commit})
    return sorted(rows, key=lambda row: row['ratio'] == '')


def commit_of(folder: Path) -> str:
    """The commit that the sources are at, 'unknown' outside of a clone."""
    described = subprocess.run(['git', '-C', str(folder), 'describe', '--always', '--dirty'],
                               capture_output=True, text=True, check=False)
    return described.stdout.strip() or 'unknown'


def all_cases(programs: list[Path], steps: Steps) -> list[Case]:
    """Runs the benchmarks; Failure where one fails."""
    cases: list[Case] = []
    for path in programs:
        steps.next(path.name)
        run = subprocess.run([str(path), '--benchmark_format=json'], stdout=subprocess.PIPE,
                             text=True, check=False)
        if run.returncode != 0:
            raise Failure(f'{path.name} ended with exit code {run.returncode}')
        cases += cases_of(run.stdout)
    steps.next('start')
    return cases + start_cases()


def measure(out: Path, json: bool, keep: bool) -> None:
    """Runs all benchmarks one after the other and writes out/core.csv, with `keep` also
    bench/history.csv.
    """
    programs = [program(name) for name in PROGRAMS]
    steps = Steps(len(programs) + 1)
    with watchdog():
        cases = all_cases(programs, steps)
    rows = rows_of(cases, commit_of(Path(__file__).resolve().parent))
    write_csv(out / 'core.csv', COLUMNS, ([row[key] for key in COLUMNS] for row in rows))
    if keep:
        history.add(history.FILE, angen_module().__version__, rows)
    steps.close()
    if json:
        print(as_json(rows))
        return
    show(table(('RATIO', 'CASE', 'CPU us', 'COUNTERS'),
               [(row['ratio'], row['case'], f"{float(row['cpu_ns']) / 1e3:.2f}", row['counters'])
                for row in rows], right=('RATIO', 'CPU us')))
    print(f"wrote {out / 'core.csv'}")
