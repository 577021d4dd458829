"""angen check."""
from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'


def angen(*words: str, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *words], text=True, timeout=60,
                          stdin=subprocess.DEVNULL, **{'capture_output': True, **options})


def test_check_of_a_right_world() -> None:
    done = angen('check', str(ROOT / 'worlds/empty.world'))
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.endswith('nothing is wrong; 1 models, 0 devices, 0 sensors\n')


def test_check_of_a_broken_world_names_file_and_line(tmp_path: Path) -> None:
    broken = tmp_path / 'broken.world'
    broken.write_text('<sdf version="1.6"><world name="w">\n'
                      '<include><uri>model://no_such_model</uri></include>\n</world></sdf>')
    done = angen('check', str(broken))
    assert done.returncode == 1 and done.stdout == ''
    line, = done.stderr.splitlines()
    assert line.startswith(f'{broken}:2: ') and 'no_such_model' in line
