"""The shipped automations over their scenarios: each naive one must fail, each good one pass.

    python3 bench/automation/shipped.py [--out out]

in ./angen shell; pictures are in the folder.
"""
import argparse
import sys
from pathlib import Path
from typing import Iterator

from angen_apps.automation.command import test

EXAMPLES = Path(__file__).resolve().parents[2] / 'examples/automation'


def each_variant() -> Iterator[tuple[str, str, int]]:
    """Scenario, variant, and the exit code that is right."""
    for naive in sorted(EXAMPLES.glob('*_naive.yaml')):
        name = naive.stem.removesuffix('_naive')
        if (EXAMPLES / f'{name}.yaml').exists():
            yield name, 'naive', 1
            yield name, 'good', 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--out', type=Path, default=Path('out'))
    args = parser.parse_args()
    wrong = 0
    for name, variant, expected in each_variant():
        code = test([EXAMPLES / f'{name}.yaml'], [EXAMPLES / f'{name}_{variant}.yaml'],
                    args.out / f'{name}_{variant}', False)
        wrong += code != expected
    print('all as they should be' if not wrong else f'{wrong} are not as they should be')
    sys.exit(wrong > 0)


if __name__ == '__main__':
    main()
