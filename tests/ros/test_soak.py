"""angen bench soak with a node: 1,000 spawns and deletions of all kinds leave nothing behind."""
import csv
import os
import subprocess
import sys
from pathlib import Path

from harness import SCRIPT, without_sanitizer

CYCLES = 1000


@without_sanitizer
def test_a_thousand_cycles_leave_nothing_behind(tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, str(SCRIPT), 'bench', 'soak', '--cycles', str(CYCLES),
                           '--out', str(tmp_path)], env=dict(os.environ, TMPDIR=str(tmp_path)),
                          text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    with (tmp_path / 'soak.csv').open() as file:
        rows = list(csv.DictReader(file))
    assert int(rows[-1]['cycle']) in (CYCLES, 2 * CYCLES)  # twice, if memory seemed to grow
    assert all(float(row['rss_mb']) > 1 and int(row['descriptors']) > 10 for row in rows)
