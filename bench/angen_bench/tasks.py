"""Runs demo, seek and care in imported homes: results, times and failures."""
import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Sequence

from angen_bench.homes import cases, import_case
from angen_tools.common.progress import Progress
from angen_tools.common.watchdog import watchdog

TASKS = {'demo': ['task', 'patrol'], 'seek': ['task', 'seek'],
         'care': ['care', '--residents', '1', '--for', '1h']}
LONGEST = 1800.0  # s of wall time of a task
SAYS = 'angen: '
ENDED: dict[int | str, str] = {0: 'done', 1: 'failed'}  # by exit code


def measure(folder: Path, files: Sequence[Path] = ()) -> list[dict[str, Any]]:
    """A row for each task in the nine homes, two scans and the files of the user."""
    plans = cases(folder, files)
    rows = []
    with Progress('homes', 0.0) as progress:
        for i, case in enumerate(plans):
            world = import_case(case, folder).path
            for name, words in TASKS.items():
                progress.update(i / len(plans), f'{case.name}: {name}')
                row = {'plan': case.name, 'task': name,
                       **run([*words, str(world)], folder / f'{world.stem}_{name}')}
                progress.note(', '.join(f'{key} {value}' for key, value in row.items()))
                rows.append(row)
    return rows


def run(words: Sequence[str], out: Path) -> dict[str, Any]:
    """Runs a command of angen; how it ended, its wall time, and what it found or why it failed."""
    began = time.monotonic()
    code: int | str
    try:
        with watchdog():
            done = subprocess.run(
                [sys.executable, sys.argv[0], *words, '--out', str(out), '--json'],
                capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=LONGEST)
        code, answer, said = done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired as late:
        code, answer, said = 'no end', '', (late.stderr or b'').decode()
    return {'ended': ENDED.get(code, code), 'wall s': round(time.monotonic() - began),
            **judged(answer, said)}


def judged(answer: str, said: str) -> dict[str, Any]:
    """The simulated time and the result of a task's JSON; what failed by its last lines."""
    remarks = [line.removeprefix(SAYS) for line in said.splitlines()
               if line.startswith(SAYS) and '%' not in line]
    missed = sum('does not reach' in line or 'is left out' in line for line in remarks)
    try:
        found = json.loads(answer)
    except ValueError:
        return {'simulated s': '', 'result': remarks[-1] if remarks else '', 'left out': missed}
    if isinstance(found, list):
        return {'simulated s': 3600, 'result': f'{len(found)} warnings', 'left out': missed}
    if 'waypoints' in found:
        visited = found['waypoints']
        result = f'{visited} of {visited + missed} rooms, {found["distance_m"]:.0f} m'
    else:
        result = f'found in {found["room"]}' if found['found'] else 'no person found'
    return {'simulated s': round(found['time_s']),
            'result': f'{result}, {found["collisions"]} collisions', 'left out': missed}
