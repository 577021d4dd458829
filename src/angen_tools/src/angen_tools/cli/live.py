"""The commands that work on the running simulator."""
import argparse
import shlex
import sys
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Collection, Container, Sequence

from angen_tools.cli import complete
from angen_tools.cli.arguments import checked, link, new_name, pose, setting
from angen_tools.cli.parser import MEANT, Parser, add_json, command
from angen_tools.common import verbs
from angen_tools.common.catalog import Plugin, has_parameter, kinds
from angen_tools.common.output import show, show_done


COMMON = ('lamp', 'door')  # devices that are meant where a command does not say which


def run_spawn(args: argparse.Namespace) -> int:
    from angen_tools.live import spawn
    if args.kind == 'model':
        done = spawn.spawn_model(args.source, args.name, args.pose)
    elif args.kind == 'sitter':
        done = spawn.seat_sitter(args.name, args.on)
    else:
        if args.pose is None and not args.on:
            args.parser.error('give --pose "X Y Z" in the world, or --on MODEL::LINK')
        done = spawn.spawn_sensor(args.kind, args.name, args.pose or (0.0,) * 6, args.on or '',
                                  args.set)
    show_done(done, args.json)
    return 0


def run_delete(args: argparse.Namespace) -> int:
    from angen_tools.live import spawn
    deleted = spawn.delete(args.names, yes if sys.stdin.isatty() and not args.yes else None)
    show_done({'deleted': deleted, 'text': f'deleted {", ".join(deleted)}'}, args.json)
    return 0


def yes(question: str) -> bool:
    """Whether the user says so."""
    return input(f'{question} [y/N] ').strip().lower() in ('y', 'yes')


def run_list(args: argparse.Namespace) -> int:
    from angen_tools.live import listing
    show(listing.list_entities(args.kind, args.json))
    return 0


def run_set(args: argparse.Namespace) -> int:
    from angen_tools.live import control
    try:
        show_done(control.set_device(args.kind, args.name, args.values), args.json)
    except ValueError as error:
        args.parser.error(str(error))
    return 0


def run_save(args: argparse.Namespace) -> int:
    from angen_tools.live import spawn
    show_done(spawn.save(args.file), args.json)
    return 0


def run_watch(args: argparse.Namespace) -> int:
    from angen_tools.live import watch
    from angen_tools.live.summary import Filter
    shown_rows = Filter(args.names, args.kind, args.room, args.active)
    if not args.once and not args.json:
        watch.watch(shown_rows)
        return 0
    shown, missing = watch.watch_once(shown_rows, args.json)
    show(shown)
    if missing:
        print(f'angen: {missing}', file=sys.stderr)
    return 1 if missing else 0


def run_top(args: argparse.Namespace) -> int:
    from angen_tools.live import top
    if args.once or args.json:
        show(top.top_once(args.json))
    else:
        top.top()
    return 0


def run_drive(args: argparse.Namespace) -> int:
    from angen_tools.live import drive
    drive.drive(args.robot, args.json)
    return 0


def add_spawn(commands: Any) -> None:
    spawn = command(commands, 'spawn', run_spawn, 'adds a sensor or a model to the world',
                    'spawn pir p1 --pose "1 1 1.2 0 0 0"',
                    'spawn model chair chair1',
                    'spawn model my_shelf/model.sdf shelf --pose "2 2 0"')
    choices = spawn.add_subparsers(dest='kind', metavar='KIND', required=True)
    for _, kind in sorted(kinds('sensor').items()):
        add_sensor(choices, kind)
    model = command(choices, 'model', run_spawn, 'adds a model',
                    'spawn model model://kitchen_door kitchen_door2 --pose "2.405 3.94 8 0 0 0"',
                    'spawn model my_shelf/model.sdf shelf --pose "1 2 0"')
    complete.completed_by(model.add_argument(
        'source', metavar='PATH|model://NAME', help='a file or folder, or an '
        'address on ANGEN_MODEL_PATH, GAZEBO_MODEL_PATH or in worlds/models'), complete.sources)
    add_name(model)
    add_json(model)
    model.add_argument('--pose', metavar='"X Y Z [R P Y]"', type=checked(pose), help='m and rad '
                       '(or 90deg), in the world; without, a place that is free, which it prints')
    sitter = command(choices, 'sitter', run_spawn, 'seats a person of 75 kg on a chair',
                     'spawn sitter ann --on kitchen_chair0_a')
    add_name(sitter)
    complete.completed_by(sitter.add_argument(
        '--on', metavar='MODEL', required=True,
        help='a model with a seat: a chair, a sofa, an armchair'), complete.names_of('model'))
    add_json(sitter)


def add_sensor(choices: Any, kind: Plugin) -> None:
    """angen spawn KIND, of a kind of sensor in the catalog."""
    name = kind['kind']
    on_link = bool(kind['sensor_type']) and not kind['models']
    where = '--on MODEL::LINK' if on_link else '--pose "1 1 1"'
    sensor = command(choices, name, run_spawn, lower_first(kind['doc']),
                     kind['example'] or f'spawn {name} {name}1 {where}',
                     more=parameter_lines(kind))
    sensor.set_defaults(parser=sensor)
    add_name(sensor)
    sensor.add_argument('--on', metavar='MODEL::LINK', type=checked(link), required=on_link,
                        help='the link that carries it'
                        + ('' if on_link else '; without it, the sensor is a model of its own, '
                           'fixed in the world')
                        + ('; it watches all collisions of that link unless --set collision=NAME'
                           if has_parameter(kind, 'contact/collision') else ''))
    complete.completed_by(
        sensor.add_argument('--set', metavar='KEY=VALUE', action='append', default=[],
                            type=checked(setting), help='a parameter; those below'),
        lambda **_: [f'{param["path"]}=' for param in kind['params']])
    sensor.add_argument('--pose', metavar='"X Y Z [R P Y]"', type=checked(pose), help='m and rad '
                        '(or 90deg), in the world; with --on, in the frame of that link (0 0 0)')
    add_json(sensor)


def lower_first(doc: str) -> str:
    """A line of doc within a sentence."""
    return (doc[:1].lower() + doc[1:]).rstrip('.')


def parameter_lines(kind: Plugin) -> str:
    """The parameters of a kind, for the end of its help."""
    rows = []
    for param in kind['params']:
        default = ' '.join(filter(None, (param['default'], param['unit'])))
        rows.append((param['path'], param['doc'] + (f' ({default})' if default else '')))
    return 'parameters (default):\n' + '\n'.join(aligned(rows)) if rows else ''


def aligned(rows: Sequence[tuple[str, str]]) -> list[str]:
    """Lines of two columns."""
    width = max(len(left) for left, _ in rows)
    return [f'  {left:{width}}  {right}' for left, right in rows]


def add_name(parser: Parser) -> None:
    parser.add_argument('name', metavar='NAME', type=checked(new_name),
                        help='a name that is not in use')


def add_delete(commands: Any) -> None:
    delete = command(commands, 'delete', run_delete, 'deletes models and sensors from the world',
                     'delete p1 chair1')
    complete.completed_by(delete.add_argument('names', metavar='NAME', nargs='+'),
                          complete.names_to_delete)
    delete.add_argument('--yes', action='store_true', help='does not ask before it deletes walls')
    add_json(delete)


def add_list(commands: Any) -> None:
    lists = command(commands, 'list', run_list, 'lists the contents of the world',
                    'list --kind door', 'list --json')
    complete.completed_by(
        lists.add_argument('--kind', metavar='KIND', default='',
                           help='only model, or a kind that angen plugins lists'),
        complete.kind_names)
    add_json(lists)


def right_order(words: Sequence[str], commands: Container[str] = ()) -> str:
    """The corrected command for a name before its kind, as `set kitchen0 door open`, a value before
    its name, as `set door open kitchen0` and `open door kitchen0`, a missing `set` or NAME, a
    model as a kind, as `spawn chair c1`, or a misspelled one without NAME; else ''. `commands` are
    those of angen."""
    devices = kinds('device')
    if words and words[0] in commands and words[0] not in ('set', 'spawn'):
        return ''
    if len(words) >= 3 and words[0] in devices:
        return shlex.join(['set', *words])
    if len(words) == 3 and words[1] in devices and _takes(devices[words[1]], words[0]):
        return shlex.join(['set', words[1], words[2], words[0]])
    if len(words) < 3 or words[0] not in ('set', 'spawn'):
        return ''
    if list(words[:2]) == ['spawn', 'model'] and len(words) == 3:
        return _spelled(words[2])
    known = kinds('device' if words[0] == 'set' else 'sensor')
    first, second, *rest = words[1:]
    if words[0] == 'set' and not rest and first in known and _takes(known[first], second):
        return f'set {first} NAME {second}'
    if first in known and words[0] == 'set' and len(rest) == 1:
        swapped = _takes(known[first], second) and not _takes(known[first], rest[0])
        return shlex.join(['set', first, rest[0], second]) if swapped else ''
    if words[0] == 'spawn' and first not in known and _is_model(first):
        return shlex.join(['spawn', 'model', first, second, *rest])
    if words[0] == 'set' and first == 'all':
        return next((shlex.join(['set', kind, *words[1:]]) for kind in (*COMMON, *known)
                     if _takes(known[kind], ' '.join(words[2:]))), '')
    if first in (*known, 'model', 'sitter'):
        return ''
    if words[0] == 'set' and not rest and not near_kind(first, known):
        return next((f'set {kind} {shlex.join(words[1:])}' for kind in (*COMMON, *known)
                     if _takes(known[kind], second)), '')
    if second not in (*known, 'model', 'sitter'):
        return ''
    return shlex.join([words[0], second, first, *rest])


def near_kind(word: str, known: Collection[str]) -> bool:
    """Whether a word may be a kind that is misspelled, or another word for one."""
    return bool({word, word.removesuffix('s')} & set(MEANT) or get_close_matches(word, known))


def _spelled(model: str) -> str:
    """The command for a model that there is not, whose NAME is missing; else ''."""
    from angen_tools.common.nearest import nearest
    from angen_tools.world.models import addresses
    known = addresses()
    address = f'model://{model.removeprefix("model://")}'
    if model.startswith('-') or '/' in model.removeprefix('model://') or address in known \
            or Path(model).exists() or not known:
        return ''
    return f'spawn model {nearest(address, known)[0]} NAME'


def _takes(kind: Plugin, word: str) -> bool:
    try:
        return bool(verbs.parse(kind, [word]))
    except ValueError:
        return False


def _is_model(name: str) -> bool:
    """Whether model://NAME is found: not so of model and sitter, which are kinds to spawn."""
    from angen_tools.world.models import addresses
    return (name not in ('model', 'sitter')
            and f'model://{name.removeprefix("model://")}' in addresses())


def add_set(commands: Any) -> None:
    parser = command(commands, 'set', run_set, 'commands a device: a door, a lamp, …',
                     'set door kitchen0 open', 'set elevator elevator 1', 'set lamp kitchen0 40')
    choices = parser.add_subparsers(dest='kind', metavar='KIND', required=True)
    for _, kind in sorted(kinds('device').items()):
        if kind['verbs'] or kind['values']:
            add_device(choices, kind)


def add_device(choices: Any, kind: Plugin) -> None:
    """angen set KIND, of a kind of device in the catalog."""
    name = kind['kind']
    device = command(choices, name, run_set, lower_first(kind['doc']),
                     kind['example'] or f'set {name} NAME {verbs.forms(kind)[0]}',
                     more='values:\n' + '\n'.join(aligned(verbs.described_forms(kind))))
    device.set_defaults(parser=device)
    complete.completed_by(device.add_argument(
        'name', metavar='NAME', help=f'its name, as angen list --kind {name} shows it, or all'),
        complete.names_of_devices(name))
    complete.completed_by(device.add_argument(
        'values', metavar='VALUE', nargs='+', help='; '.join(verbs.forms(kind))),
        lambda **_: [verb['name'].lower() for verb in kind['verbs']])
    add_json(device)


def add_save(commands: Any) -> None:
    save = command(commands, 'save', run_save, 'writes the current world to a file',
                   'save out.world')
    save.add_argument('file', metavar='FILE', type=Path)
    add_json(save)


def add_watch(commands: Any) -> None:
    watch = command(commands, 'watch', run_watch,
                    'shows every sensor and device live; space turns the page, q quits',
                    'watch', 'watch --once', 'watch --room kitchen --active',
                    'watch --kind pir --kind lamp --once --json')
    complete.completed_by(
        watch.add_argument('names', metavar='NAME', nargs='*', help='only those of these names'),
        complete.names_to_watch)
    complete.completed_by(
        watch.add_argument('--kind', metavar='KIND', action='append', default=[],
                           help='only this kind; may be given more than once'),
        complete.kind_names)
    watch.add_argument('--room', metavar='WORD', default='',
                       help='only those with this word in the name of their room, or '
                       'in their own')
    watch.add_argument('--active', action='store_true', help='only sensors that detect something '
                       'and, of kinds that do not detect, those that changed within 5 s')
    watch.add_argument('--once', action='store_true',
                       help="prints one table, after each sensor's first reading; ends with 1 "
                       'if one is missing')
    watch.add_argument('--json', action='store_true', help='prints one table as JSON')


def add_top(commands: Any) -> None:
    top = command(commands, 'top', run_top,
                  'shows the CPU time of each device and sensor, live; space turns the page, '
                  'q quits',
                  'top', 'top --once')
    top.add_argument('--once', action='store_true', help='prints one table')
    top.add_argument('--json', action='store_true', help='prints one table as JSON')


def add_drive(commands: Any) -> None:
    parser = command(commands, 'drive', run_drive, 'drives a robot by the arrow keys',
                     'drive', 'drive --robot robot2')
    complete.completed_by(parser.add_argument(
        '--robot', metavar='NAME',
        help='which robot, as angen list --kind drive shows it (the first)'),
        complete.names_of('drive'))
    parser.add_argument('--json', action='store_true',
                        help='prints each change of the command as a line of JSON')
