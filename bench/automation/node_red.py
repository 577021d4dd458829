"""Node-RED with the built-in building, and with the scenarios of examples/automation.

    python3 bench/automation/node_red.py [--folder /tmp/node_red] [WHAT ...]

in ./angen shell, with mosquitto, npm and a network: it installs Node-RED 4.1 into the folder. WHAT
is
    bench      the shipped flows over their scenarios: each naive one must fail, each good one pass
    picture    docs/images/node_red.png: its editor beside angen mqtt, in chromium
Without a word it does bench.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from bridged import bridged, save
from shipped import EXAMPLES, each_variant

from angen_tools.cli.main import run
from harness import end, free_port

MESSAGES = 8  # in the picture
SETTINGS = """module.exports = {httpAdminRoot: ADMIN, httpNodeRoot: false, flowFile: 'flow.json',
  uiHost: '127.0.0.1', uiPort: PORT, diagnostics: {enabled: false}, telemetry: {enabled: false},
  editorTheme: {tours: false}};
"""
BROKER = {'id': 'broker', 'type': 'mqtt-broker', 'broker': '127.0.0.1', 'port': '${ANGEN_PORT}',
          'autoConnect': True, 'protocolVersion': '4', 'keepalive': '60', 'cleansession': True}
SHOWN = [
    {'id': 'tab', 'type': 'tab', 'label': 'Motion light'}, BROKER,
    {'id': 'motion', 'type': 'mqtt in', 'z': 'tab', 'topic': 'angen/pir/+/motion', 'qos': '0',
     'datatype': 'utf8', 'broker': 'broker', 'x': 170, 'y': 100, 'wires': [['lamp', 'debug']]},
    {'id': 'lamp', 'type': 'mqtt out', 'z': 'tab', 'topic': 'angen/lamp/kitchen0/state/set',
     'qos': '0', 'broker': 'broker', 'x': 470, 'y': 100, 'wires': []},
    {'id': 'state', 'type': 'mqtt in', 'z': 'tab', 'topic': 'angen/lamp/kitchen0/+', 'qos': '0',
     'datatype': 'utf8', 'broker': 'broker', 'x': 170, 'y': 180, 'wires': [['debug']]},
    {'id': 'debug', 'type': 'debug', 'z': 'tab', 'name': 'shown', 'active': True, 'tosidebar': True,
     'complete': 'payload', 'targetType': 'msg', 'x': 450, 'y': 180, 'wires': []}]


def prepare(user: Path, flow: str, admin: str) -> int:
    """Writes what Node-RED reads in its folder; the port of its page."""
    port = free_port()
    (user / 'settings.js').write_text(
        SETTINGS.replace('PORT', str(port)).replace('ADMIN', admin))
    (user / 'flow.json').write_text(flow)
    return port


def tested(program: Path, scenario: str, flow: str, out: Path) -> int:
    """The exit code of a scenario with a flow."""
    with tempfile.TemporaryDirectory(prefix='angen_node_red_') as name:
        user = Path(name)
        prepare(user, (EXAMPLES / flow).read_text(), 'false')
        command = f'env ANGEN_PORT={{port}} ANGEN_START={{start}} node {program} -u {user}'
        return run(['automation-test', str(EXAMPLES / f'{scenario}.yaml'), '--out', str(out),
                    '--program', command])


def bench(program: Path, out: Path) -> int:
    """How many flows have another verdict than they should."""
    wrong = 0
    for name, variant, expected in each_variant():
        wrong += tested(program, name, f'{name}_{variant}_flow.json',
                        out / f'{name}_{variant}') != expected
    wrong += tested(program, 'hall_light', 'hall_light_flow.json', out / 'hall_light') != 0
    print('all as they should be' if not wrong else f'{wrong} are not as they should be')
    return wrong


def picture(program: Path) -> int:
    """A flow of two nodes that is a motion light, with what it receives in the sidebar."""
    from browser import Page
    with tempfile.TemporaryDirectory(prefix='angen_node_red_') as name:
        folder = Path(name)
        port = prepare(folder, json.dumps(SHOWN), "'/'")
        with bridged(folder) as (broker, _):
            page, server = Page(folder, 1280, 720), subprocess.Popen(
                ['node', str(program), '-u', str(folder)],
                env={**os.environ, 'ANGEN_PORT': str(broker)})
            try:
                show(page, f'http://127.0.0.1:{port}/')
            finally:
                page.close()
                end(server)
    return 0


def show(page: Any, address: str) -> None:
    from browser import LIMIT
    from harness import until
    from selenium.common.exceptions import WebDriverException

    def answers() -> bool:
        try:
            page.driver.get(address)
        except WebDriverException:
            return False
        return True

    until(answers, 'Node-RED', LIMIT)
    page.until('return window.RED && RED.sidebar && RED.nodes.node("debug")')
    page.driver.execute_script('RED.sidebar.show("debug"); RED.view.select({nodes: []})')
    page.until(f'return document.querySelectorAll(".red-ui-debug-msg").length >= {MESSAGES}')
    save(page, 'node_red.png')


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--folder', type=Path, default=Path('/tmp/node_red'))
    parser.add_argument('--out', type=Path, default=Path('out'))
    parser.add_argument('what', nargs='*', default=['bench'], choices=['bench', 'picture'])
    args = parser.parse_args()
    program = args.folder / 'node_modules/node-red/red.js'
    if not program.exists():
        args.folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(['npm', 'install', '--no-audit', '--no-fund', 'node-red@4.1'],
                       cwd=args.folder, check=True)
    sys.exit(sum({'bench': lambda: bench(program, args.out),
                  'picture': lambda: picture(program)}[what]() for what in args.what) > 0)


if __name__ == '__main__':
    main()
