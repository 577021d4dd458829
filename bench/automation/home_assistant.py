"""Home Assistant beside the bridge: are all entities there, can they be commanded?

    python3 bench/automation/home_assistant.py [--folder /tmp/home_assistant]

in ./angen shell, with mosquitto and a network: it installs Home Assistant 2024.3.3, the last for
Python 3.11, into the folder.
"""
from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT), str(ROOT / 'tests/ros')]
from harness import Master, end, free_port, until  # noqa: E402

from tests.angen_apps.mqtt.mosquitto import Client, Mosquitto  # noqa: E402

SCRIPT = ROOT / 'src/angen_apps/scripts/mqtt'
VERSION = '2024.3.3'


def installed(folder: Path) -> Path:
    """The Python of an environment with Home Assistant."""
    python = folder / 'bin/python3'
    if not (folder / 'bin/hass').exists():
        venv.create(folder, with_pip=True)
        subprocess.run([python, '-m', 'pip', 'install', '-q', f'homeassistant=={VERSION}',
                        'paho-mqtt==1.6.1'], check=True)
        constraints, = folder.glob('lib/*/site-packages/homeassistant/package_constraints.txt')
        subprocess.run([python, '-m', 'pip', 'install', '-q', '-c', constraints, 'janus',
                        'aiohttp-fast-url-dispatcher', 'aiohttp-zlib-ng'], check=True)
    return python


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--folder', type=Path, default=Path('/tmp/home_assistant'))
    args = parser.parse_args()
    python = installed(args.folder)
    folder = Path(tempfile.mkdtemp(prefix='angen_home_assistant_'))
    mosquitto, master = Mosquitto(folder), Master(folder)
    os.environ.update(master.environment)
    node = master.node(ROOT / 'worlds/angen.world', folder / 'log')
    client = Client(mosquitto.port)
    bridge = subprocess.Popen([sys.executable, str(SCRIPT), '--broker',
                               f'127.0.0.1:{mosquitto.port}'], env=master.environment, text=True)
    try:
        client.has('angen/bridge/state', 'online', 120.0)
        until(lambda: 'angen/lamp/kitchen0/state' in client.retained, 'the lamp', 60.0)
        discovered = len(client.configs())
        environment = {key: value for key, value in os.environ.items() if key != 'PYTHONPATH'}
        done = subprocess.run(
            [python, str(Path(__file__).with_name('in_home_assistant.py')), str(folder),
             str(mosquitto.port), str(free_port())], stdout=subprocess.PIPE, text=True,
            env=environment, check=True)
        found = json.loads(done.stdout)
        print(done.stdout.strip())
        client.has('angen/lamp/kitchen0/brightness', '40')
        print(f'{found["entities"]} entities of {discovered} discovery messages; '
              f'{len(found["complaints"])} complaints')
    finally:
        end(bridge)
        end(node)
        client.close()
        mosquitto.stop()
        end(master.process)


if __name__ == '__main__':
    main()
