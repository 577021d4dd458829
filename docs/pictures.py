#!/usr/bin/env python3
"""Makes pictures of the pages again, from this version: ./angen docs --pictures [NAME ...]"""
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / 'docs/images'


@dataclass(frozen=True)
class Made:
    """A command, and what it writes to OUT by the name that it has in docs/images; or it writes
    there itself."""

    command: str
    copies: dict[str, str] = field(default_factory=dict)


PICTURES = {
    'thesis': Made('python3 docs/thesis_figures.py'),
    'plots': Made('python3 docs/plots.py'),
    'rviz': Made("xvfb-run -a -s '-screen 0 1500x1060x24' python3 docs/rviz_picture.py"),
    'residents': Made("xvfb-run -a -s '-screen 0 1500x1060x24' python3 docs/residents_picture.py"),
    'web': Made('python3 docs/web_pictures.py'),
    'day': Made('angen generate --days 1 --seed 7 --residents retired,worker --out OUT/day && '
                'angen web --replay OUT/day --video OUT/day.gif --start 8:15 --speed 360 '
                '--size 960x640', {'day.gif': 'day.gif'}),
    'care': Made('angen care worlds/care/wrong.world --day worlds/care/wrong.csv --out OUT',
                 {'care.png': 'care.png'}),
    'locate': Made('angen locate worlds/angen.world --for 240 --out OUT',
                   {'locate.png': 'locate.png'}),
    'situations': Made('angen situations --only furniture --plan OUT/situations.png',
                       {'situations.png': 'situations.png'}),
    'automation': Made('angen automation-test examples/automation/reading_light.yaml --automation '
                       'examples/automation/reading_light_naive.yaml --out OUT || [ $? = 1 ]',
                       {'automation.png': 'automation.png'}),
    'month': Made("sed 's/lasts: 24 h/lasts: 30 d/' examples/automation/two_people.yaml "
                  '> OUT/month.yaml && angen automation-test OUT/month.yaml --compare '
                  'examples/automation/lights_naive.yaml examples/automation/lights_good.yaml '
                  '--out OUT', {'compare.png': 'automation_compare.png'}),
    'home_assistant': Made('python3 bench/automation/home_assistant.py picture'),
    'node_red': Made('python3 bench/automation/node_red.py picture'),
    'task': Made('angen task patrol --out OUT', {'floor_0.png': 'patrol_floor_0.png',
                                                 'floor_1.png': 'patrol_floor_1.png'}),
    'controllers': Made('angen pid door --out OUT && angen pid elevator --out OUT',
                        {'pid_door.png': 'pid_door.png', 'pid_elevator.png': 'pid_elevator.png'}),
}


def make(name: str) -> None:
    """Runs the command of a group, and replaces its pictures when it has succeeded."""
    made, began = PICTURES[name], time.monotonic()
    with tempfile.TemporaryDirectory() as out:
        done = subprocess.run(['bash', '-ec', made.command.replace('OUT', shlex.quote(out))],
                              cwd=ROOT, stdin=subprocess.DEVNULL)
        if done.returncode:
            sys.exit(f'{name}: {made.command} has ended with {done.returncode}')
        for source, target in made.copies.items():
            shutil.copy(Path(out) / source, IMAGES / target)
            print(IMAGES / target)
    print(f'{name}: {time.monotonic() - began:.0f} s', flush=True)


def main(names: list[str]) -> None:
    """Makes the named groups, or all."""
    unknown = [name for name in names if name not in PICTURES]
    if unknown:
        print(f'no pictures {", ".join(unknown)}; known are {", ".join(PICTURES)}',
              file=sys.stderr)
        sys.exit(2)
    for name in names or PICTURES:
        make(name)


if __name__ == '__main__':
    main(sys.argv[1:])
