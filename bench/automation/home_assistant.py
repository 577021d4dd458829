"""Home Assistant with the built-in building, and with the scenarios of examples/automation.

    python3 bench/automation/home_assistant.py [--folder /tmp/home_assistant] [WHAT ...]

in ./angen shell, with mosquitto and a network: it installs Home Assistant 2024.3.3, the last for
Python 3.11, into the folder. WHAT is
    entities   are all entities there, can they be commanded? (beside angen mqtt)
    picture    the same, and docs/images/home_assistant.png: its dashboard, in chromium
    bench      the shipped automations over their scenarios, by its own clock, told by the bench
    wall       one scenario at rate 1, by the wall's clock, which takes half an hour
Without a word it does entities and bench.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time
import venv
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Iterator

from bridged import ROOT, bridged, save
from shipped import EXAMPLES, each_variant

from angen_tools.cli.main import run
from harness import free_port
from tests.angen_apps.mqtt.mosquitto import Client

VERSION = '2024.3.3'
NEEDED = ('paho-mqtt==1.6.1', 'janus', 'aiohttp-fast-url-dispatcher', 'aiohttp-zlib-ng', 'numpy',
          'home-assistant-frontend', 'Pillow', 'psutil-home-assistant', 'SQLAlchemy',
          'fnv-hash-fast', 'josepy<2')  # of its integrations mqtt, http and frontend
SHOWN = ('light.kitchen_lamp', 'cover.bathroom_door', 'binary_sensor.kitchen_stove',
         'binary_sensor.kitchen_motion_sensor_a', 'sensor.kitchen_light_sensor',
         'select.elevator', 'switch.simulation_paused')
ICONS = 20.0  # s in which they come, one by one
LOADED = """return performance.getEntriesByType('resource').some(
    (each) => each.name.endsWith('/local/plan.png'))"""


def installed(folder: Path) -> Path:
    """The Python of an environment with Home Assistant."""
    python = folder / 'bin/python3'
    if not (folder / 'bin/hass').exists():
        venv.create(folder, with_pip=True)
        pip = [python, '-m', 'pip', 'install', '-q']
        subprocess.run([*pip, '--no-deps', f'homeassistant=={VERSION}'], check=True)
        constraints, = folder.glob('lib/*/site-packages/homeassistant/package_constraints.txt')
        subprocess.run([*pip, '-c', constraints, f'homeassistant=={VERSION}', *NEEDED], check=True)
    return python


@contextmanager
def beside_bridge(python: Path, folder: Path) -> Iterator[tuple[dict[str, Any], Client]]:
    """Home Assistant beside the bridge of the built-in building: what it says, and the broker's
    client."""
    with bridged(folder) as (port, client):
        http = free_port()
        with subprocess.Popen(
                [python, str(Path(__file__).with_name('in_home_assistant.py')), str(folder),
                 str(port), str(http)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                text=True, env=plain_environment()) as assistant:
            assert assistant.stdout is not None
            found = json.loads(assistant.stdout.readline())
            client.has('angen/lamp/kitchen0/brightness', '40')
            yield {**found, 'messages': len(client.configs()), 'http': http}, client
            assistant.communicate()


def plain_environment() -> dict[str, str]:
    return {key: value for key, value in os.environ.items() if key != 'PYTHONPATH'}


def entities(python: Path) -> int:
    with tempfile.TemporaryDirectory(prefix='angen_home_assistant_') as name, \
            beside_bridge(python, Path(name)) as (found, _):
        print(json.dumps(found, indent=1))
        return len(found['complaints']) + len(found['unavailable'])


def picture(python: Path) -> int:
    """The plan as a card, with some entities beside it."""
    from browser import Page
    with tempfile.TemporaryDirectory(prefix='angen_home_assistant_') as name:
        folder = Path(name)
        (folder / 'www').mkdir()
        run(['plan', str(ROOT / 'worlds/angen.world'), '--card', str(folder / 'card.yaml'),
             '-o', str(folder / 'www/plan.png')])
        card = (folder / 'card.yaml').read_text().replace('\n', '\n      ')
        (folder / 'ui-lovelace.yaml').write_text(
            'title: Angen\nviews:\n- title: Home\n  panel: true\n  cards:\n'
            f'  - type: vertical-stack\n    cards:\n    - {card.strip()}\n'
            f'    - type: glance\n      columns: {len(SHOWN)}\n      entities: {list(SHOWN)}\n')
        with beside_bridge(python, folder) as (found, client):
            page = Page(folder, 1280, 900)
            try:
                page.driver.get(f'http://127.0.0.1:{found["http"]}/lovelace')
                page.until(LOADED)
                client.send('angen/simulation/simulation/paused/set', 'ON')  # it is drawn in peace
                time.sleep(ICONS)
                save(page, 'home_assistant.png')
            finally:
                page.close()
    return 0


def tested(python: Path, automations: Path, *words: str) -> str:
    """The command of a program of a scenario."""
    program = Path(__file__).with_name('tested_home_assistant.py')
    return ' '.join(('env -u PYTHONPATH', str(python), str(program), str(automations),
                     '{port} {start}', *words))


def bench(python: Path, out: Path) -> int:
    """Also says where its commands differ from those of our engine."""
    wrong = 0
    for name, variant, expected in each_variant():
        scenario, automations = EXAMPLES / f'{name}.yaml', EXAMPLES / f'{name}_{variant}.yaml'
        folder = out / f'{name}_{variant}'
        wrong += run(['automation-test', str(scenario), '--out', str(folder / 'assistant'),
                      '--program', tested(python, automations)]) != expected
        wrong += run(['automation-test', str(scenario), '--out', str(folder / 'engine'),
                      '--automation', str(automations)]) != expected
        for of, times in (('assistant', moments(folder / 'assistant')),
                          ('engine', moments(folder / 'engine'))):
            print(f'  {of:10}', *times)
    print('all as they should be' if not wrong else f'{wrong} are not as they should be')
    return wrong


def moments(folder: Path) -> list[str]:
    """When something was commanded, s."""
    with (folder / 'commands.csv').open() as file:
        return sorted({row['time'] for row in csv.DictReader(file)}, key=float)


def wall(python: Path, out: Path) -> int:
    """The night light, whose timers run for two minutes."""
    scenario = out / 'wall.yaml'
    before, _, after = (EXAMPLES / 'night_light.yaml').read_text().partition('automation:')
    program = tested(python, EXAMPLES / 'night_light_good.yaml', '--wall')
    scenario.write_text(f"{before}program: {{run: '{program}', answers: quiet, rate: 1}}"
                        + after[after.index('\n'):])
    code = run(['automation-test', str(scenario), '--out', str(out / 'wall')])
    print(*moments(out / 'wall'))
    return code


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--folder', type=Path, default=Path('/tmp/home_assistant'))
    parser.add_argument('--out', type=Path, default=Path('out'))
    parser.add_argument('what', nargs='*', default=['entities', 'bench'],
                        choices=['entities', 'picture', 'bench', 'wall'])
    args = parser.parse_args()
    python = installed(args.folder)
    args.out.mkdir(parents=True, exist_ok=True)
    wrong = 0
    for what in args.what:
        wrong += {'entities': lambda: entities(python), 'picture': lambda: picture(python),
                  'bench': lambda: bench(python, args.out),
                  'wall': lambda: wall(python, args.out)}[what]()
    sys.exit(wrong > 0)


if __name__ == '__main__':
    main()
