"""The parts that the subcommands of angen are made of."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Callable, NoReturn

Run = Callable[[argparse.Namespace], int]  # does what the words say; returns the exit code


class Parser(argparse.ArgumentParser):
    """Reports in one line what is wrong with the words."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f'{self.prog}: {message}; see {self.prog} --help\n')


def command(commands: Any, name: str, run: Run, summary: str, *examples: str) -> Parser:
    """Adds a subcommand whose help ends with examples."""
    parser: Parser = commands.add_parser(
        name, help=summary, description=summary[0].upper() + summary[1:] + '.',
        epilog='example:\n' + '\n'.join(f'  angen {example}' for example in examples),
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.set_defaults(run=run)
    return parser


def add_json(parser: Parser) -> None:
    """The option of every command that prints a table."""
    parser.add_argument('--json', action='store_true', help='prints JSON instead of a table')


def add_out(parser: Parser, what: str) -> None:
    """The folder in which a command leaves files."""
    parser.add_argument('-o', '--out', metavar='DIR', type=Path, default=Path('out'),
                        help=f'folder for {what} (out)')
