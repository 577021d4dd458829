"""An import in a process of its own: its end, and what it cost."""
import json
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

SCRIPT = Path(__file__).resolve().parents[3] / 'src/angen_tools/scripts/angen'
# Starts it from a small process: exec keeps the memory of the process which forked.
OUTER = '''
import json, resource, subprocess, sys
code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps([code, used.ru_maxrss << 10, used.ru_utime + used.ru_stime]))
'''


class Measured(NamedTuple):
    """`memory` in bytes, `cpu` in s."""

    code: int
    memory: int
    cpu: float
    said: str


def import_measured(path: Path, *words: str) -> Measured:
    done = subprocess.run([sys.executable, '-c', OUTER, sys.executable, SCRIPT, 'import', path,
                           '-o', path.with_name('made.world'), *words], capture_output=True,
                          text=True, check=True)
    code, memory, cpu = json.loads(done.stdout)
    return Measured(code, memory, cpu, done.stderr)
