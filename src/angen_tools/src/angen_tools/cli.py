# PYTHON_ARGCOMPLETE_OK
"""The angen command: its words, and how it ends."""
from __future__ import annotations

import argparse
import os
import signal
import sys
from pathlib import Path
from typing import Any, Callable, NoReturn, Sequence

from . import bench_words, fast_words, robot_words, task_words, walktest_words
from .client import leave
from .failure import Failure

STOPPED = 130  # what a shell says of a command that Ctrl-C ended
PIPE_CLOSED = 141  # and of one whose reader went away


class Parser(argparse.ArgumentParser):
    """Says in one line what is wrong with the words."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f'{self.prog}: {message}; see {self.prog} --help\n')


def checked(check: Callable[[str], Any]) -> Callable[[str], Any]:
    """`check` for argparse, which shows only errors of its own type in full."""
    def run(text: str) -> Any:
        try:
            return check(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
    return run


def pose(text: str) -> Any:
    from .sdf import parse_pose
    return parse_pose(text)


def new_name(text: str) -> str:
    from .sdf import check_name
    return check_name(text)


def link(text: str) -> str:
    from .sdf import check_link
    return check_link(text)


def setting(text: str) -> tuple[str, str]:
    from .sdf import parse_settings
    return parse_settings([text])[0]


def run_spawn(args: argparse.Namespace) -> int:
    from . import spawn
    if args.kind == 'model':
        print(spawn.spawn_model(args.source, args.name, args.pose))
    elif args.kind == 'sitter':
        print(spawn.seat_sitter(args.name, args.on))
    else:
        print(spawn.spawn_sensor(args.kind, args.name, args.pose, args.on or '', args.set))
    return 0


def run_delete(args: argparse.Namespace) -> int:
    from . import spawn
    print(f'deleted {", ".join(spawn.delete(args.names))}')
    return 0


def run_list(args: argparse.Namespace) -> int:
    from . import listing
    print(listing.list_entities(args.kind, args.json))
    return 0


def run_plugins(args: argparse.Namespace) -> int:
    from . import listing
    print(listing.list_plugins(args.json))
    return 0


def run_set(args: argparse.Namespace) -> int:
    from . import control
    print(control.set_device(args.kind, args.name, args.value))
    return 0


def run_save(args: argparse.Namespace) -> int:
    from . import spawn
    print(spawn.save(args.file))
    return 0


def run_watch(args: argparse.Namespace) -> int:
    from . import watch
    if args.once:
        print(watch.watch_once())
    else:
        watch.watch()
    return 0


def run_top(args: argparse.Namespace) -> int:
    from . import top
    if args.once:
        print(top.top_once())
    else:
        top.top()
    return 0


def run_check(args: argparse.Namespace) -> int:
    from . import listing
    wrong, right = listing.check_world(args.world)
    for line in wrong:
        print(line, file=sys.stderr)
    if not wrong:
        print(right)
    return 1 if wrong else 0


def run_luxcheck(_: argparse.Namespace) -> int:
    from . import luxcheck
    table, right = luxcheck.check()
    print(table)
    return 0 if right else 1


def run_completion(args: argparse.Namespace) -> int:
    import argcomplete
    print(argcomplete.shellcode(['angen'], shell=args.shell))
    return 0


def names_of(*kinds: str) -> Callable[..., list[str]]:
    """A completer: names of what is in the running simulator, none where there is no simulator."""
    def complete(**_: Any) -> list[str]:
        from .client import Client
        try:
            return [e.name for e in Client(limit=1.0).entities() if e.kind in kinds]
        except Failure:
            return []
    return complete


def command(commands: Any, name: str, run: Callable[[argparse.Namespace], int], summary: str,
            *examples: str) -> argparse.ArgumentParser:
    """Adds a subcommand whose help ends with examples."""
    parser = commands.add_parser(
        name, help=summary, description=summary[0].upper() + summary[1:] + '.',
        epilog='example:\n' + '\n'.join(f'  angen {example}' for example in examples),
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.set_defaults(run=run)
    return parser


SENSOR_WORDS = {'pressure': 'a pressure mat', 'reed': 'a reed contact', 'rfid': 'an RFID reader',
                'plug': 'a smart plug'}


def add_spawn(commands: Any) -> None:
    spawn = command(commands, 'spawn', run_spawn, 'adds a sensor or a model to the world',
                    'spawn pir p1 --pose "1 1 1.2 0 0 0"',
                    'spawn model model://chair chair1 --pose "2 2 0"')
    kinds = spawn.add_subparsers(dest='kind', metavar='KIND', required=True)
    examples = {
        'pir': ['spawn pir p1 --pose "1 1 1.2 0 0 0" --set ray/range/max=4',
                'spawn pir p2 --on turtlebot::base_footprint --pose "0 0 0.5"'],
        'switch': ['spawn switch s1 --pose "2.1 3.94 2.125"'],
        'luminosity': ['spawn luminosity l1 --pose "2 0.1 2.2 0 0 1.57" --set update_rate=5'],
        'camera': ['spawn camera c1 --pose "0.8 0.8 2.2 0 0.4 0.785"'],
        'contact': ['spawn contact c1 --on kitchen_chair0_a::body --set collision=seat_collision'],
        'proximity': ['spawn proximity d1 --pose "1 1 0.5 0 0 1.57" --set ray/range/max=2'],
        'pressure': ['spawn pressure m1 --pose "1 2 0" --set threshold=20'],
        'reed': ['spawn reed r1 --on kitchen_door0::base --pose "0.93 -0.015 2.09" '
                 '--set magnet_link=door --set magnet="0.93 -0.015 2.078"'],
        'rfid': ['spawn rfid gate --pose "0.2 5 1.2 0 0 0" --set max_range=1.5'],
        'plug': ['spawn plug p1 --pose "0.1 1 0.3 0 0 0" --set load=lamp/kitchen0'],
        'temperature': ['spawn temperature t1 --pose "0.1 2 1.5" --set noise_stddev=0.1'],
        'humidity': ['spawn humidity h1 --pose "0.1 2.1 1.5"'],
    }
    for kind, lines in examples.items():
        what = SENSOR_WORDS.get(kind, f'a {kind} sensor')
        sensor = command(kinds, kind, run_spawn, f'adds {what}', *lines)
        sensor.add_argument('name', metavar='NAME', type=checked(new_name),
                            help='a name that nothing has yet')
        sensor.add_argument('--on', metavar='MODEL::LINK', type=checked(link),
                            required=kind in ('contact', 'reed'),
                            help='the link that carries it' + (
                                '' if kind in ('contact', 'reed') else '; a static model without'))
        sensor.add_argument('--set', metavar='KEY=VALUE', action='append', default=[],
                            type=checked(setting), help='a parameter, as angen plugins lists them')
        add_pose(sensor, required=kind != 'contact')
    model = command(kinds, 'model', run_spawn, 'adds a model',
                    'spawn model model://kitchen_door kitchen_door2 --pose "2.405 3.94 8 0 0 0"',
                    'spawn model my_shelf/model.sdf shelf --pose "1 2 0"')
    model.add_argument('source', metavar='PATH|model://NAME', help='a file or folder, or an '
                       'address on ANGEN_MODEL_PATH, GAZEBO_MODEL_PATH or in worlds/models')
    model.add_argument('name', metavar='NAME', type=checked(new_name),
                       help='a name that nothing has yet')
    add_pose(model, required=True)
    sitter = command(kinds, 'sitter', run_spawn, 'seats a person of 75 kg on a chair',
                     'spawn sitter ann --on kitchen_chair0_a')
    sitter.add_argument('name', metavar='NAME', type=checked(new_name),
                        help='a name that nothing has yet')
    seat = sitter.add_argument('--on', metavar='MODEL', required=True,
                               help='what has a seat: a chair, a sofa, an armchair')
    seat.completer = names_of('model')


def add_pose(parser: argparse.ArgumentParser, required: bool) -> None:
    parser.add_argument('--pose', metavar='"X Y Z [R P Y]"', type=checked(pose), required=required,
                        default=(0.0,) * 6, help='m and rad, in the world; with --on, in the '
                        'frame of that link')


def add_set(commands: Any) -> None:
    parser = command(commands, 'set', run_set, 'commands a device: a door, a lamp, …',
                     'set door kitchen0 open', 'set elevator elevator 1', 'set lamp kitchen0 40')
    kinds = parser.add_subparsers(dest='kind', metavar='KIND', required=True)
    for kind, values, example, many in (
            ('door', 'open|close|RAD', 'set door bathroom1 -1.2', ', or all'),
            ('window', 'open|close|RAD', 'set window window0 open', ', or all'),
            ('cabinet', 'open|close|RAD', 'set cabinet wall0 open', ', or all'),
            ('elevator', 'FLOOR', 'set elevator elevator 1', ''),
            ('lamp', 'on|off|PERCENT', 'set lamp all on', ', or all'),
            ('heater', 'on|off|PERCENT', 'set heater heater1 40', '')):
        device = command(kinds, kind, run_set, f'commands {"an" if kind[0] == "e" else "a"} {kind}',
                         example)
        name = device.add_argument('name', metavar='NAME',
                                   help=f'its name, as angen list --kind {kind} shows it{many}')
        name.completer = names_of(kind)
        device.add_argument('value', metavar=values, type=checked(valid_for(kind)))


def valid_for(kind: str) -> Callable[[str], str]:
    def valid(text: str) -> str:
        from .control import make_order
        make_order(kind, text)
        return text
    return valid


def make_parser() -> argparse.ArgumentParser:
    """All that the command understands."""
    parser = Parser(
        prog='angen', description='Works on the running simulator. Each command has --help.',
        epilog='example:\n  angen list --kind door',
        formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(metavar='COMMAND', required=True)
    add_spawn(commands)
    delete = command(commands, 'delete', run_delete, 'takes models and sensors out of the world',
                     'delete p1 chair1')
    delete.add_argument('names', metavar='NAME', nargs='+').completer = names_of(
        'model', 'pir', 'switch', 'luminosity', 'contact', 'camera', 'proximity', 'pressure',
        'reed', 'rfid', 'plug', 'temperature', 'humidity')
    lists = command(commands, 'list', run_list, 'lists what is in the world',
                    'list --kind door', 'list --json')
    lists.add_argument('--kind', default='', help='only door, elevator, lamp, pir, model, …')
    plugins = command(commands, 'plugins', run_plugins,
                      'lists the plug-ins and their parameters; needs no simulator', 'plugins')
    for listing in (lists, plugins):
        listing.add_argument('--json', action='store_true', help='as JSON')
    add_set(commands)
    save = command(commands, 'save', run_save, 'writes the world as it stands to a file',
                   'save out.world')
    save.add_argument('file', metavar='FILE', type=Path)
    watch = command(commands, 'watch', run_watch,
                    'shows every device and sensor live; space turns the page, q quits',
                    'watch', 'watch --once')
    watch.add_argument('--once', action='store_true', help='prints one table')
    top = command(commands, 'top', run_top,
                  'shows live what each device and sensor costs; space turns the page, q quits',
                  'top', 'top --once')
    top.add_argument('--once', action='store_true', help='prints one table')
    check = command(commands, 'check', run_check,
                    'says what is wrong with a world file; needs no simulator',
                    'check worlds/angen.world')
    check.add_argument('world', metavar='WORLD')
    command(commands, 'luxcheck', run_luxcheck,
            'compares the simulated light with closed forms; needs no simulator', 'luxcheck')
    robot_words.add_map(commands, command, checked)
    robot_words.add_drive(commands, command, names_of('drive'))
    fast_words.add_run(commands, command, checked)
    task_words.add_task(commands, command, checked)
    bench_words.add_world(commands, command, checked)
    bench_words.add_bench(commands, command, checked)
    walktest_words.add_walktest(commands, command, checked, setting)
    completion = command(commands, 'completion', run_completion,
                         'prints what makes a shell complete angen',
                         'completion bash >> ~/.bash_completion')
    completion.add_argument('shell', choices=['bash'])
    return parser


def run(arguments: Sequence[str]) -> int:
    """Runs the command; returns its exit code. argparse exits by itself, with 2 or 0."""
    parser = make_parser()
    if '_ARGCOMPLETE' in os.environ:
        import argcomplete
        argcomplete.autocomplete(parser)
    try:
        args = parser.parse_args(arguments)
        code = args.run(args)
        sys.stdout.flush()
        return code
    except Failure as failure:
        print(f'angen: {failure}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return STOPPED
    except BrokenPipeError:
        return PIPE_CLOSED
    except OSError as error:
        print(f'angen: cannot write: {error.strerror}', file=sys.stderr)
        return 1


def stop(number: int, _: Any) -> NoReturn:
    """At a signal: what was started is ended on the way out."""
    sys.exit(128 + number)  # as a shell says of a command that a signal ended


def main() -> None:
    """The program. Ends at once: threads that still wait for an answer are not waited for."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, stop)
    try:
        code = run(sys.argv[1:])
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 1
    try:
        leave()
    except KeyboardInterrupt:
        code = STOPPED
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            pass
    os._exit(code)
