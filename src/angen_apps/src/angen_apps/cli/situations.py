"""angen situations on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.parser import add_json, command


def run_situations(args: argparse.Namespace) -> int:
    from angen_apps.situations.command import run
    return 0 if run(args.only, args.json, args.page, args.plan) else 1


def add_situations(commands: Any) -> None:
    """angen situations."""
    battery = command(commands, 'situations', run_situations,
                      'plays everyday situations before a PIR and compares its reports with the '
                      'expectations of physics and data sheets; needs no simulator',
                      'situations', 'situations --only postures')
    battery.add_argument('--only', metavar='WORDS', default='',
                         help='those with these words in their group or scene')
    battery.add_argument('--page', metavar='FILE', type=Path,
                         help='also writes the table into this page, between its marks')
    battery.add_argument('--plan', metavar='FILE', type=Path,
                         help='also draws the plan of each into a PNG file')
    add_json(battery)
