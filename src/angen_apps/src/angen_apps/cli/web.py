"""angen web on the command line."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import checked
from angen_tools.cli.parser import Parser, add_world_file, command
from angen_tools.common.port import port

PORT = 8080


def run_web(args: argparse.Namespace) -> int:
    from angen_apps.web.command import web_live, web_recording
    if args.world is not None and args.replay is None:
        args.parser.error('WORLD needs --replay; the world of a run is that of ./angen run')
    if args.replay is not None:
        web_recording(args.replay, args.world, args.host, args.port, args.json)
    else:
        web_live(args.host, args.port, args.json)
    return 0


def add_web(commands: Any) -> None:
    """angen web."""
    web = command(commands, 'web', run_web,
                  'serves a page that shows the running building, to watch and control it in a '
                  'browser', 'web', 'web --port 9000', 'web --host 0.0.0.0',
                  'web --replay bug.log', 'web --replay out')
    web.set_defaults(parser=web)
    web.add_argument('--replay', metavar='FILE', type=Path,
                     help='plays a run that record:= of ./angen run has recorded, or a home of '
                     'angen generate, with a time line')
    add_world_file(web, 'the world of --replay, if it is of a home of your own')
    add_address(web, PORT)


def add_address(parser: Parser, at: int) -> None:
    """The options of a command that serves a page."""
    parser.add_argument('--port', metavar='N', type=checked(port), default=at,
                        help=f'port of the page ({at})')
    parser.add_argument('--host', metavar='ADDRESS', default='127.0.0.1',
                        help='an address of this machine that other machines reach, or 0.0.0.0: '
                        'the address that it prints then has a token (127.0.0.1)')
    parser.add_argument('--json', action='store_true', help='prints the address as JSON')
