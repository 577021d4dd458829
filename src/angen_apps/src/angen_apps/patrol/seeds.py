"""angen task patrol --seeds N: one patrol after the other, each with its seed, and a table."""
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

from angen_apps.patrol.report import Figures, read_figures, verdict
from angen_apps.robot.tables import write_figures
from angen_tools.common.failure import Failure
from angen_tools.common.output import as_json, show, table
from angen_tools.common.progress import Steps
from angen_tools.common.watchdog import watchdog

HEAD = ('SEED', 'm', 's', 'WALL s', 'COLLISIONS', 'ELEVATOR mm', 'ASIDE cm', 'WHEELS cm')


def patrols(words: list[str], seeds: range, out: Path, json: bool) -> int:
    """Runs `angen task patrol WORDS` for each seed in OUT/seed_N, and writes OUT/summary.csv.

    0, or 1 where one touched something or its elevator was not level; Failure if one did not
    arrive.
    """
    found: list[Figures] = []
    steps = Steps(len(seeds))
    try:
        for seed in seeds:
            steps.next(f'seed {seed}')
            with watchdog():
                found.append(patrol(words, seed, out / f'seed_{seed}'))
            write_figures(Figures, found, out / 'summary.csv')
    finally:
        steps.close()
        if found:
            print(as_json([asdict(f) for f in found]), flush=True) if json else _report(found, out)
    return max(verdict(figures) for figures in found)


def _report(found: list[Figures], out: Path) -> None:
    show(table(HEAD, [(str(f.seed), f'{f.distance_m:.1f}', f'{f.time_s:.1f}', f'{f.wall_s:.0f}',
                       str(f.collisions), f'{f.elevator_mm:.2f}', f'{100 * f.aside_m:.1f}',
                       f'{100 * f.wheels_m:.0f}') for f in found], right=HEAD))
    print(f'{len(found)} runs, {sum(f.collisions for f in found)} collisions; elevator at most '
          f'{max(f.elevator_mm for f in found):.2f} mm beside its level; {out}/summary.csv',
          flush=True)


def patrol(words: list[str], seed: int, folder: Path) -> Figures:
    """Runs one; Failure with its last line where it did not arrive."""
    summary = folder / 'summary.csv'
    summary.unlink(missing_ok=True)
    process = subprocess.Popen(
        [sys.executable, sys.argv[0], 'task', 'patrol', *words, '--seed', str(seed), '--out',
         str(folder)],
        text=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        lines = process.communicate()[1].splitlines()
    except BaseException:
        process.terminate()
        process.wait()
        raise
    if not summary.exists():
        last = lines[-1] if lines else f'ended with {process.returncode}'
        raise Failure(f'seed {seed}: {last}')
    figures, = read_figures(summary)
    return figures
