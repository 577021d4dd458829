"""The commands that need no running simulator: plugins, check, home, luxcheck, world, run,
replay."""
import argparse
from dataclasses import asdict
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import at_least, checked, duration, moment
from angen_tools.cli.complete import completed_by, kind_names
from angen_tools.cli.parser import (add_allow_paths, add_file, add_json, add_out, add_seed,
                                    add_world_file, command)
from angen_tools.common.files import check_folder, check_output
from angen_tools.common.output import as_json, show, show_done

KINDS = ('pir', 'switch', 'luminosity', 'contact')
MOVERS = ('person', 'robot', 'nobody')


def run_plugins(args: argparse.Namespace) -> int:
    from angen_tools.offline.plugins import list_plugins
    show(list_plugins(args.names, args.json))
    return 0


def run_check(args: argparse.Namespace) -> int:
    import sys

    from angen_tools.offline.check import check
    code, every = 0, []
    for path in args.paths:
        checked = check(path)
        code = 1 if checked.wrong else code
        every.append({'path': path, **asdict(checked)})
        if args.json:
            continue
        for line in checked.wrong + [f'warning: {warning}' for warning in checked.warnings]:
            print(line, file=sys.stderr)
        for ignored in checked.ignored:
            print(f'ignored: {ignored}')
        if not checked.wrong:
            print(checked.found)
    if args.json:
        print(as_json(every))
    return code


def run_home(args: argparse.Namespace) -> int:
    from angen_tools.offline.home import home_json, home_text, load_home
    print((home_json if args.json else home_text)(*load_home(args.world)))
    return 0


def run_luxcheck(args: argparse.Namespace) -> int:
    from angen_tools.offline.luxcheck import check, list_cases
    cases = check()
    show(list_cases(cases, args.json))
    return 0 if all(case.passes for case in cases) else 1


def run_world(args: argparse.Namespace) -> int:
    from angen_tools.world.apartment import write_apartment
    check_output(args.output)
    sensors = write_apartment(
        args.output, args.floors, {kind: getattr(args, kind) for kind in KINDS}, args.seed,
        args.elevator, args.mover, args.one_link)
    show_done({'file': str(args.output), 'floors': args.floors, 'sensors': sensors,
               'text': f'wrote {args.output}: {args.floors} floor{"s"[:args.floors > 1]}, '
                       f'{sensors} sensors'}, args.json)
    return 0


def run_fast(args: argparse.Namespace) -> int:
    from angen_tools.offline.fast_run import run
    check_folder(args.out)
    done = run(args.world, args.span, args.seed, args.out, args.day, args.readings)
    print(as_json(asdict(done)) if args.json else done.text())
    return 0


def run_replay(args: argparse.Namespace) -> int:
    from angen_tools.offline.replay import continue_in_ros, replay
    if args.until is not None:
        continue_in_ros(args.log, args.until)
    show_done(replay(args.log, not args.every_tick), args.json)
    return 0


def add_plugins(commands: Any) -> None:
    plugins = command(commands, 'plugins', run_plugins,
                      'lists the plug-ins and their parameters; needs no simulator', 'plugins',
                      'plugins door pir')
    completed_by(plugins.add_argument('names', metavar='KIND', nargs='*',
                                      help='only these kinds, or those of these libraries'),
                 kind_names)
    add_json(plugins)


def add_checks(commands: Any) -> None:
    """angen check, angen home, angen luxcheck."""
    check = command(commands, 'check', run_check,
                    'reports errors in files of worlds, models and robots; needs no '
                    'simulator', 'check worlds/angen.world',
                    'check my_models/shelf robot.urdf model://bath_door0')
    check.add_argument('paths', metavar='PATH', nargs='+', help='a world, a model (SDF, URDF, or '
                       'its folder), or model://NAME')
    add_allow_paths(check)
    add_json(check)
    home = command(commands, 'home', run_home,
                   'prints the rooms of a world, its doors and the contents of the rooms, and '
                   'lists missing and wrong parts; needs no simulator', 'home worlds/angen.world',
                   'home worlds/angen.world --json')
    add_world_file(home, 'the SDF file of the world', True, str)
    add_json(home)
    add_allow_paths(home)
    lux = command(commands, 'luxcheck', run_luxcheck,
                  'compares the simulated light with closed forms; needs no simulator', 'luxcheck')
    add_json(lux)


def add_world(commands: Any) -> None:
    """angen world apartment."""
    world = command(commands, 'world', run_world, 'writes a world; needs no simulator',
                    'world apartment --floors 2 --pir 50 -o out.world')
    world.kinds = kinds = world.add_subparsers(dest='what', metavar='WHAT', required=True)
    made = command(kinds, 'apartment', run_world,
                   'writes apartments, one above the other, with sensors',
                   'world apartment --floors 2 --pir 50 --switch 12 -o out.world')
    made.add_argument('--floors', metavar='N', type=checked(at_least(1, 1000)), default=2,
                      help='how many floors, of an apartment each (2)')
    for kind in KINDS:
        made.add_argument(f'--{kind}', metavar='N', type=checked(at_least(0)), default=0,
                          help=f'how many {kind} sensors' +
                          (', each with its chair or table (0)' if kind == 'contact' else ' (0)'))
    made.add_argument('--elevator', action='store_true',
                      help='with the elevator of floors 0 and 1, which has one of the '
                           'contact sensors')
    made.add_argument('--mover', choices=MOVERS, default='person', help='who is on floor 0: '
                      'a person who walks; a robot, which drives in the workroom when it is sent '
                      '(person)')
    made.add_argument('--one-link', action='store_true',
                      help='puts all sensors of a kind on one link, not each in its own model; '
                      'contact sensors stay on the furniture')
    add_json(made)
    add_seed(made, 'of the places that are left to chance')
    add_file(made)
    world.epilog = made.format_help()


def add_run(commands: Any) -> None:
    """angen run --fast."""
    run = command(commands, 'run', run_fast,
                  'runs a world without ROS, leaping over time in which nothing happens, and '
                  'writes its events to a CSV file; for ROS: ./angen run NAME:=VALUE …',
                  'run --fast worlds/angen.world --for 1h',
                  'run --fast worlds/care/ordinary.world --for 24h --day '
                  'worlds/care/ordinary.csv')
    add_world_file(run, 'the SDF file of the building', True, str)
    run.add_argument('--fast', action='store_true', required=True,
                     help='as fast as possible; the only way without ROS')
    run.add_argument('--for', metavar='TIME', dest='span', type=checked(duration),
                     required=True, help='how much time to simulate: 90 (s), 10m, 24h')
    run.add_argument('--day', metavar='FILE', type=Path, help='commands to devices at times of '
                     'day: a CSV file with time,target,command; the run begins at the time of day '
                     'of the world, or at 0:00')
    run.add_argument('--readings', metavar='FILE', type=Path, help='writes all readings as a long '
                     'table; its name ends in .csv, .csv.gz or .parquet')
    add_seed(run, 'of all noise')
    add_allow_paths(run)
    add_json(run)
    add_out(run, 'events.csv')


def add_replay(commands: Any) -> None:
    """angen replay."""
    parser = command(commands, 'replay', run_replay,
                     'runs a session again that record:= recorded, and compares it second by '
                     'second; needs no simulator', 'replay bug.log', 'replay bug.log --until 41.5')
    parser.add_argument('log', metavar='FILE', help='the log of ./angen run record:=FILE')
    ways = parser.add_mutually_exclusive_group()
    ways.add_argument('--until', metavar='SECONDS', type=checked(moment), help='continues live in '
                      'ROS from that simulated time')
    ways.add_argument('--every-tick', action='store_true',
                      help='leaps over nothing; the fingerprints are the same')
    add_allow_paths(parser)
    add_json(parser)
