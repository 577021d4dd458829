"""angen bench sensors against real nodes: its output, never the speed."""
import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from harness import ROOT, processes_with, until

# The angen command. Warm-ups make figures comparable, and no test reads the values of figures.
PROGRAM = '''
from angen_bench import sensors
from angen_tools.common.program import run_main
sensors.WARM_UP = sensors.PLANTS_READ = 1.0
run_main('angen_tools.cli.main')
'''


def start(folder: Path, *words: str) -> subprocess.Popen[str]:
    command = [sys.executable, '-c', PROGRAM, 'bench', 'sensors', '--window', '1',
               '--out', str(folder)]
    path = f'{ROOT}/bench:{os.environ["PYTHONPATH"]}'
    return subprocess.Popen([*command, *words], text=True, stdin=subprocess.DEVNULL,
                            env=dict(os.environ, TMPDIR=str(folder), PYTHONPATH=path),
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def read(path: Path) -> list[dict[str, str]]:
    with path.open() as file:
        return list(csv.DictReader(file))


def running(folder: Path) -> list[int]:
    """Processes that the bench has started and left."""
    return processes_with(f'ROS_HOME={folder}/angen_bench_')


def test_a_small_bench_measures_and_leaves_nothing_behind(tmp_path: Path) -> None:
    bench = start(tmp_path, '--kind', 'pir', '--counts', '0,1', '--repeats', '1', '--mode',
                  'deployed')
    said, trouble = bench.communicate(timeout=300)
    assert bench.returncode == 0, trouble
    none, one = read(tmp_path / 'sensors_pir_deployed.csv')
    assert (none['count'], one['count'], one['repeats']) == ('0', '1', '1')
    for row in (none, one):
        assert float(row['server_cpu']) > 0 and float(row['rtf']) > 0 and float(row['rss_mb']) > 1
        assert float(row['rtf_fast']) > 0
    assert none['delivered'] == none['first_reading_ms'] == ''
    assert float(one['delivered']) > 0 and float(one['received']) > 0
    assert float(one['first_reading_ms']) > 0 and float(one['deploy_s']) > 0
    assert (tmp_path / 'sensors_pir_deployed.png').read_bytes().startswith(b'\x89PNG')
    slow = [row['count'] for row in (none, one) if row['real_time'] == 'no']
    assert (f'not fitted, as not in real time: {", ".join(slow)}' if slow
            else 'server: one more sensor costs') in said
    until(lambda: not running(tmp_path), 'all that it started ends')
    assert not list(tmp_path.glob('angen_bench_*'))


def test_a_signal_ends_all_and_keeps_the_measurements(tmp_path: Path) -> None:
    """SIGTERM; test_patrol_run has SIGINT, too, of the same processes."""
    bench = start(tmp_path, '--kind', 'switch', '--counts', '1,10', '--repeats', '1')
    table = tmp_path / 'sensors_switch_added.csv'
    end = time.monotonic() + 300
    while not (table.exists() and read(table)):
        assert bench.poll() is None and time.monotonic() < end
        time.sleep(0.05)
    bench.send_signal(signal.SIGTERM)
    bench.communicate(timeout=120)
    assert bench.returncode == 128 + signal.SIGTERM
    first = read(table)[0]
    assert first['count'] == '1' and float(first['delivered']) > 0
    assert first['first_reading_ms'] == first['deploy_s'] == ''
    assert (tmp_path / 'sensors_switch_added.png').exists()
    until(lambda: not running(tmp_path), 'all that it started ends')
