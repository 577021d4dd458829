"""Commands of other packages. Each of these modules has add_commands(commands)."""
from __future__ import annotations

import argparse
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

from angen_tools.cli.parser import command
from angen_tools.common.failure import Failure

MODULES = ('angen_apps.cli.commands', 'angen_bench.commands')
BENCH = Path(__file__).resolve().parents[5] / 'bench'  # in a checkout; it is not installed


def run_absent_bench(_: argparse.Namespace) -> int:
    raise Failure('the benchmarks are not installed; run ./angen bench in a checkout of Angen, '
                  'which has them in bench/angen_bench')


def add_commands(commands: Any) -> None:
    """Adds the commands of the packages that are there."""
    if (BENCH / 'angen_bench').is_dir() and str(BENCH) not in sys.path:
        sys.path.append(str(BENCH))
    for name in MODULES:
        try:
            module = import_module(name)
        except ModuleNotFoundError as error:
            if error.name != name.partition('.')[0]:
                raise
        else:
            module.add_commands(commands)
    if 'bench' not in commands.choices:
        absent = command(commands, 'bench', run_absent_bench, 'measures costs; only in '
                         'a checkout', 'bench')
        absent.add_argument('words', nargs=argparse.REMAINDER, help=argparse.SUPPRESS)
