"""angen replay: runs a recorded session again, and compares its fingerprints."""
import os
import sys
import time
from typing import Any

from angen_tools.common.catalog import simulator
from angen_tools.common.failure import Failure
from angen_tools.common.progress import Progress
from angen_tools.world.models import worlds_models

SLICE = 1.0  # simulated s between two progress reports


def replay(path: str, leap: bool) -> dict[str, Any]:
    """A report of the comparison, if all is equal; Failure if it is not, or cannot be read."""
    began = time.monotonic()
    with simulator() as angen:
        run = angen.Replay(path, leap=leap)
        with Progress(path) as progress:
            while run.advance(SLICE) and not run.mismatch:
                progress.update(min(run.time / max(run.end, SLICE), 1.0))
    if run.truncated:
        print(f'warning: {run.truncated}', file=sys.stderr)
    if run.mismatch:
        raise Failure(f'{run.mismatch} ({run.compared} before it were equal)')
    wall = time.monotonic() - began
    found = (f'all {run.compared} fingerprints are equal' if run.compared
             else 'without a fingerprint to compare')
    return {'log': path, 'actions': run.actions, 'simulated_s': run.time, 'compared': run.compared,
            'wall_s': wall, 'text': f'{path}: {run.actions} actions in {run.time:g} s, {found}; '
                                    f'took {wall:.1f} s'}


def continue_in_ros(path: str, until: float) -> None:
    """Replaces this process by the building in ROS, as it was at that time; it continues live."""
    launch = worlds_models().parent.parent / 'launch/angen.launch'
    os.execv(sys.executable, [sys.executable, '-m', 'angen_tools.entry.run', str(launch.resolve()),
                              f'replay:={path}', f'until:={until:.9g}'])
