"""angen web on the command line."""
import argparse
import re
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import checked, duration, moment, rate
from angen_tools.cli.parser import Parser, add_world_file, command
from angen_tools.common.clock import time_of_day
from angen_tools.common.port import port

PORT = 8080
SECONDS, VIEWS = 10.0, ('3d', 'plan')  # the usual ones of a video


SIZE = (1280, 720)
LEAST, MOST = 160, 3840  # px of a side of a video
FILM = ('start', 'seconds', 'speed', 'size', 'view')


def size(text: str) -> tuple[int, int]:
    """Width and height of '1280x720'; even, as videos need."""
    found = re.fullmatch(r'(\d{3,4})[x×](\d{3,4})', text)
    sides = [int(side) for side in found.groups()] if found else []
    if not sides or any(side % 2 or not LEAST <= side <= MOST for side in sides):
        raise ValueError(f"'{text}' is not a size; give it as 1280x720, even numbers from {LEAST} "
                         f'to {MOST}')
    return sides[0], sides[1]


def start(text: str) -> str | float:
    """Seconds since the start, or a time of day."""
    if ':' not in text:
        return moment(text)
    time_of_day(text)
    return text


def speed(text: str) -> float:
    """Simulated seconds per second, more than 0."""
    value = rate(text)
    if not value:
        raise ValueError('0 is not a speed; give more than 0')
    return value


def run_web(args: argparse.Namespace) -> int:
    from angen_apps.web.command import web_live, web_recording, web_video
    if args.world is not None and args.replay is None:
        args.parser.error('WORLD needs --replay; the world of a run is that of ./angen run')
    given = [name for name in FILM if getattr(args, name) is not None]
    if args.video is None and given:
        args.parser.error(f'--{given[0]} needs --video')
    if args.start is not None and args.replay is None:
        args.parser.error('--start needs --replay; the running building is filmed from now on')
    if args.video is not None:
        from angen_apps.web.film import Film
        web_video(Film(args.video, args.start, args.seconds or SECONDS, args.speed,
                       args.size or SIZE, args.view or VIEWS[0]), args.replay, args.world)
    elif args.replay is not None:
        web_recording(args.replay, args.world, args.host, args.port, args.json)
    else:
        web_live(args.host, args.port, args.json)
    return 0


def add_web(commands: Any) -> None:
    """angen web."""
    web = command(commands, 'web', run_web,
                  'serves a page that shows the running building, to watch and control it in a '
                  'browser', 'web', 'web --port 9000', 'web --host 0.0.0.0',
                  'web --replay bug.log', 'web --replay out',
                  'web --replay out --video day.mp4 --start 7:30')
    web.set_defaults(parser=web)
    web.add_argument('--replay', metavar='FILE', type=Path,
                     help='plays a run that record:= of ./angen run has recorded, or a home of '
                     'angen generate, with a time line')
    add_world_file(web, 'the world of --replay, if it is of a home of your own')
    add_address(web, PORT)
    film = web.add_argument_group('a video, by chromium and ffmpeg')
    film.add_argument('--video', metavar='FILE', type=Path,
                      help='writes a video of the page, .mp4, .webm or .gif: of --replay, else of '
                      'the running building from now on')
    film.add_argument('--start', metavar='TIME', type=checked(start),
                      help='where it begins: seconds since the start of the recording, or a time '
                      'of day, as 7:30 (where the page begins to play)')
    film.add_argument('--seconds', metavar='S', type=checked(duration),
                      help=f'length of the video ({SECONDS:g})')
    film.add_argument('--speed', metavar='X', type=checked(speed),
                      help='simulated seconds per second of the video (1; of a generated day 20)')
    film.add_argument('--size', metavar='WxH', type=checked(size),
                      help=f'pixels ({SIZE[0]}x{SIZE[1]})')
    film.add_argument('--view', choices=VIEWS, help=f'({VIEWS[0]})')


def add_address(parser: Parser, at: int) -> None:
    """The options of a command that serves a page."""
    parser.add_argument('--port', metavar='N', type=checked(port), default=at,
                        help=f'port of the page ({at})')
    parser.add_argument('--host', metavar='ADDRESS', default='127.0.0.1',
                        help='an address of this machine that other machines reach, or 0.0.0.0: '
                        'the address that it prints then has a token (127.0.0.1)')
    parser.add_argument('--json', action='store_true', help='prints the address as JSON')
