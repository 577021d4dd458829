"""angen plugins."""
import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'


def angen(*words: str, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *words], text=True, timeout=60,
                          stdin=subprocess.DEVNULL, **{'capture_output': True, **options})


def test_plugins_lists_the_catalog() -> None:
    done = angen('plugins', '--json')
    kinds = {plugin['kind']: plugin for plugin in json.loads(done.stdout)}
    assert {'door', 'elevator', 'lamp', 'drive', 'person', 'pir', 'switch', 'luminosity',
            'contact', 'lidar', 'camera', 'depth'} <= set(kinds)
    p, = [param for param in kinds['door']['params'] if param['path'] == 'p']
    assert (p['type'], p['default'], p['unit']) == ('number', '70', 'N m/rad') and p['doc']
    text = angen('plugins').stdout
    assert all(plugin['library'] in text for plugin in kinds.values())
    lines = [' '.join(line.split()) for line in text.splitlines()]
    assert '[dim] PERCENT of its full brightness; 0 to 100 percent' in lines  # of a lamp
    assert any(line.startswith('difference m number') for line in lines)      # of a PIR


def test_plugins_of_a_library() -> None:
    found = json.loads(angen('plugins', 'libpir_controller.so', '--json').stdout)
    assert [plugin['kind'] for plugin in found] == ['pir']


def test_a_reader_that_disconnects_is_no_error() -> None:
    done = subprocess.run(['bash', '-c', f'{sys.executable} {SCRIPT} plugins --json | true'],
                          text=True, capture_output=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, '')


def test_a_full_disk_is_reported_in_one_line() -> None:
    with open('/dev/full', 'w') as full:
        done = angen('plugins', capture_output=False, stdout=full, stderr=subprocess.PIPE)
    assert done.returncode == 1
    assert done.stderr == f'angen: cannot write: {os.strerror(28)}\n'
