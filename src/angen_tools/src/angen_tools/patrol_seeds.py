"""angen task patrol --seeds N: one patrol after the other, each with its seed, and a table."""
from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from .failure import Failure
from .patrol_report import Figures, read_figures, verdict, write_figures


def patrols(words: list[str], seeds: range, out: Path) -> int:
    """Runs `angen task patrol WORDS` for each seed in OUT/seed_N, and writes OUT/summary.csv.

    0, or 1 where one touched something or its elevator was not level; Failure where one did not
    arrive.
    """
    found: list[Figures] = []
    print(line('seed', 'm', 's', 'wall s', 'collisions', 'elevator mm', 'aside cm', 'wheels cm'))
    for seed in seeds:
        folder = out / f'seed_{seed}'
        code, trouble = patrol([*words, '--seed', str(seed), '--out', str(folder)])
        if code not in (0, 1) or trouble:
            raise Failure(f'seed {seed}: {trouble or f"ended with {code}"}')
        figures, = read_figures(folder / 'summary.csv')
        found.append(figures)
        write_figures(found, out / 'summary.csv')
        print(line(str(seed), f'{figures.distance_m:.1f}', f'{figures.time_s:.1f}',
                   f'{figures.wall_s:.0f}', str(figures.collisions), f'{figures.elevator_mm:.2f}',
                   f'{100 * figures.aside_m:.1f}', f'{100 * figures.wheels_m:.0f}'), flush=True)
    print(f'{len(found)} runs, {sum(f.collisions for f in found)} collisions; elevator at most '
          f'{max(f.elevator_mm for f in found):.2f} mm beside its level; {out}/summary.csv')
    return max(verdict(figures) for figures in found)


def line(*words: str) -> str:
    """A line of the table."""
    return ''.join(f'{word:>12}' for word in words)


def patrol(words: list[str]) -> tuple[int, str]:
    """Runs one; its exit code, and its last word where it did not arrive."""
    process = subprocess.Popen([sys.executable, sys.argv[0], 'task', 'patrol', *words], text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)

    try:
        said = process.communicate()[1].splitlines()
    except BaseException:
        process.terminate()
        process.wait()
        raise
    last = said[-1] if said else ''
    return process.returncode, '' if ' patrol ' in last else last
