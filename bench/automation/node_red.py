"""The flows of examples/automation in Node-RED through angen automation-test: each naive one must
fail, each good one pass.

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

from shipped import EXAMPLES, each_variant  # noqa: E402

from angen_tools.cli.main import run  # noqa: E402

SETTINGS = """module.exports = {httpAdminRoot: false, httpNodeRoot: false, flowFile: 'flow.json',
  uiHost: '127.0.0.1', uiPort: PORT, diagnostics: {enabled: false}, telemetry: {enabled: false}};
"""


def tested(program: Path, scenario: str, flow: str, out: Path) -> int:
    """The exit code of a scenario with a flow."""
    with tempfile.TemporaryDirectory(prefix='angen_node_red_') as name:
        user = Path(name)
        (user / 'settings.js').write_text(SETTINGS.replace('PORT', str(free_port())))
        (user / 'flow.json').write_text((EXAMPLES / flow).read_text())
        command = f'env ANGEN_PORT={{port}} ANGEN_START={{start}} node {program} -u {user}'
        return run(['automation-test', str(EXAMPLES / f'{scenario}.yaml'), '--out', str(out),
                    '--program', command])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--folder', type=Path, default=Path('/tmp/node_red'))
    parser.add_argument('--out', type=Path, default=Path('out'))
    args = parser.parse_args()
    program = args.folder / 'node_modules/node-red/red.js'
    if not program.exists():
        args.folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(['npm', 'install', '--no-audit', '--no-fund', 'node-red@4.1'],
                       cwd=args.folder, check=True)
    wrong = 0
    for name, variant, expected in each_variant():
        wrong += tested(program, name, f'{name}_{variant}_flow.json',
                        args.out / f'{name}_{variant}') != expected
    wrong += tested(program, 'hall_light', 'hall_light_flow.json', args.out / 'hall_light') != 0
    print('all as they should be' if not wrong else f'{wrong} are not as they should be')
    sys.exit(wrong > 0)


if __name__ == '__main__':
    main()
