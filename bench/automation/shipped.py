"""The shipped automations over their scenarios: each naive one must fail, each good one pass.

    python3 bench/automation/shipped.py [--out out]

in ./angen shell; pictures are in the folder.
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

from angen_apps.automation.command import test

EXAMPLES = Path(__file__).resolve().parents[2] / 'examples/automation'


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--out', type=Path, default=Path('out'))
    args = parser.parse_args()
    wrong = 0
    for naive in sorted(EXAMPLES.glob('*_naive.yaml')):
        name = naive.stem.removesuffix('_naive')
        scenario = EXAMPLES / f'{name}.yaml'
        if scenario.exists():
            for variant, expected in (('naive', 1), ('good', 0)):
                out = args.out / f'{name}_{variant}'
                code = test([scenario], [EXAMPLES / f'{name}_{variant}.yaml'], out, False)
                wrong += code != expected
    print('all as they should be' if not wrong else f'{wrong} are not as they should be')
    sys.exit(wrong > 0)


if __name__ == '__main__':
    main()
