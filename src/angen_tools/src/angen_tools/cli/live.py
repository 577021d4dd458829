"""The commands that work on the running simulator."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Callable

from angen_tools.cli.arguments import checked, link, new_name, pose, setting
from angen_tools.cli.parser import Parser, add_json, command
from angen_tools.common.failure import Failure
from angen_tools.common.output import show

SENSOR_WORDS = {'pressure': 'a pressure mat', 'reed': 'a reed contact', 'rfid': 'an RFID reader',
                'plug': 'a smart plug'}


def run_spawn(args: argparse.Namespace) -> int:
    from angen_tools.live import spawn
    if args.kind == 'model':
        print(spawn.spawn_model(args.source, args.name, args.pose))
    elif args.kind == 'sitter':
        print(spawn.seat_sitter(args.name, args.on))
    else:
        print(spawn.spawn_sensor(args.kind, args.name, args.pose, args.on or '', args.set))
    return 0


def run_delete(args: argparse.Namespace) -> int:
    from angen_tools.live import spawn
    print(f'deleted {", ".join(spawn.delete(args.names))}')
    return 0


def run_list(args: argparse.Namespace) -> int:
    from angen_tools.live import listing
    show(listing.list_entities(args.kind, args.json))
    return 0


def run_set(args: argparse.Namespace) -> int:
    from angen_tools.live import control
    print(control.set_device(args.kind, args.name, args.value))
    return 0


def run_save(args: argparse.Namespace) -> int:
    from angen_tools.live import spawn
    print(spawn.save(args.file))
    return 0


def run_watch(args: argparse.Namespace) -> int:
    from angen_tools.live import watch
    if args.once or args.json:
        show(watch.watch_once(args.json))
    else:
        watch.watch()
    return 0


def run_top(args: argparse.Namespace) -> int:
    from angen_tools.live import top
    if args.once or args.json:
        show(top.top_once(args.json))
    else:
        top.top()
    return 0


def run_drive(args: argparse.Namespace) -> int:
    from angen_tools.live import drive
    drive.drive(args.robot)
    return 0


def names_of(*kinds: str) -> Callable[..., list[str]]:
    """A completer: names of what is in the running simulator, none where there is no simulator."""
    def complete(**_: Any) -> list[str]:
        from angen_tools.live.client import Client
        try:
            return [e.name for e in Client(limit=1.0).entities() if e.kind in kinds]
        except Failure:
            return []
    return complete


def complete_names(argument: argparse.Action, *kinds: str) -> None:
    """Has argcomplete offer the names of what is in the running simulator."""
    argument.completer = names_of(*kinds)  # type: ignore[attr-defined]


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
                            help='a name that is not in use')
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
                       help='a name that is not in use')
    add_pose(model, required=True)
    sitter = command(kinds, 'sitter', run_spawn, 'seats a person of 75 kg on a chair',
                     'spawn sitter ann --on kitchen_chair0_a')
    sitter.add_argument('name', metavar='NAME', type=checked(new_name),
                        help='a name that is not in use')
    complete_names(sitter.add_argument(
        '--on', metavar='MODEL', required=True,
        help='what has a seat: a chair, a sofa, an armchair'), 'model')


def add_pose(parser: Parser, required: bool) -> None:
    parser.add_argument('--pose', metavar='"X Y Z [R P Y]"', type=checked(pose), required=required,
                        default=(0.0,) * 6, help='m and rad, in the world; with --on, in the '
                        'frame of that link')


def add_delete(commands: Any) -> None:
    delete = command(commands, 'delete', run_delete, 'takes models and sensors out of the world',
                     'delete p1 chair1')
    complete_names(
        delete.add_argument('names', metavar='NAME', nargs='+'),
        'model', 'pir', 'switch', 'luminosity', 'contact', 'camera', 'proximity', 'pressure',
        'reed', 'rfid', 'plug', 'temperature', 'humidity')


def add_list(commands: Any) -> None:
    lists = command(commands, 'list', run_list, 'lists what is in the world',
                    'list --kind door', 'list --json')
    lists.add_argument('--kind', default='', help='only door, elevator, lamp, pir, model, …')
    add_json(lists)


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
        complete_names(device.add_argument(
            'name', metavar='NAME',
            help=f'its name, as angen list --kind {kind} shows it{many}'), kind)
        device.add_argument('value', metavar=values, type=checked(valid_for(kind)))


def valid_for(kind: str) -> Callable[[str], str]:
    def valid(text: str) -> str:
        from angen_tools.live.control import make_order
        make_order(kind, text)
        return text
    return valid


def add_save(commands: Any) -> None:
    save = command(commands, 'save', run_save, 'writes the current world to a file',
                   'save out.world')
    save.add_argument('file', metavar='FILE', type=Path)


def add_watch(commands: Any) -> None:
    watch = command(commands, 'watch', run_watch,
                    'shows every device and sensor live; space turns the page, q quits',
                    'watch', 'watch --once')
    watch.add_argument('--once', action='store_true', help='prints one table')
    watch.add_argument('--json', action='store_true', help='prints one table as JSON')


def add_top(commands: Any) -> None:
    top = command(commands, 'top', run_top,
                  'shows live what each device and sensor costs; space turns the page, q quits',
                  'top', 'top --once')
    top.add_argument('--once', action='store_true', help='prints one table')
    top.add_argument('--json', action='store_true', help='prints one table as JSON')


def add_drive(commands: Any) -> None:
    parser = command(commands, 'drive', run_drive, 'drives a robot by the arrow keys',
                     'drive', 'drive --robot robot2')
    complete_names(parser.add_argument(
        '--robot', metavar='NAME', help='as angen list --kind drive shows it (the first)'), 'drive')
