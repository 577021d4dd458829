"""A flow of Node-RED through angen automation-test.

    python3 bench/automation/node_red.py [--folder /tmp/node_red]

in ./angen shell, with mosquitto, npm and a network: it installs Node-RED 4.1 into the folder.
"""
from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / 'tests/ros'))
from harness import free_port  # noqa: E402

from angen_tools.cli.main import run  # noqa: E402

EXAMPLES = ROOT / 'examples/automation'
SETTINGS = """module.exports = {httpAdminRoot: false, httpNodeRoot: false, flowFile: 'flow.json',
  uiHost: '127.0.0.1', uiPort: PORT, diagnostics: {enabled: false}, telemetry: {enabled: false}};
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--folder', type=Path, default=Path('/tmp/node_red'))
    args = parser.parse_args()
    program = args.folder / 'node_modules/node-red/red.js'
    if not program.exists():
        args.folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(['npm', 'install', '--no-audit', '--no-fund', 'node-red@4.1'],
                       cwd=args.folder, check=True)
    with tempfile.TemporaryDirectory(prefix='angen_node_red_') as name:
        user = Path(name)
        (user / 'settings.js').write_text(SETTINGS.replace('PORT', str(free_port())))
        (user / 'flow.json').write_text((EXAMPLES / 'motion_light_flow.json').read_text())
        before, _, rest = (EXAMPLES / 'motion_light.yaml').read_text().partition('program:')
        command = f'env ANGEN_PORT={{port}} node {program} -u {user}'
        scenario = user / 'motion_light.yaml'
        scenario.write_text(f'{before}program: {{run: "{command}"}}{rest[rest.index(chr(10)):]}')
        sys.exit(run(['automation-test', str(scenario), '--out', str(user)]))


if __name__ == '__main__':
    main()
