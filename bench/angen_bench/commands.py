"""angen bench on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import at_least, checked, counts, window
from angen_tools.cli.parser import add_json, add_out, command
from angen_tools.common.failure import Failure
from angen_tools.common.files import check_folder

KINDS = ('pir', 'switch', 'luminosity', 'contact')


def run_bench(args: argparse.Namespace) -> int:
    from angen_bench import sensors
    check_folder(args.out)
    if args.vs:
        from angen_bench import contest
        if args.mode != 'added':
            raise Failure('--vs compares sensors that are there at the start: give --mode added')
        contest.measure(sensors.cases('added', args.kind, args.counts, 'robot'), args.repeats,
                        args.window, args.out, args.chroot, args.json)
    else:
        sensors.measure(sensors.cases(args.mode, args.kind, args.counts), args.repeats,
                        args.window, args.out, args.json)
    return 0


def run_bench_core(args: argparse.Namespace) -> int:
    from angen_bench import core
    check_folder(args.out)
    core.measure(args.out, args.json, args.history)
    return 0


def run_bench_load(args: argparse.Namespace) -> int:
    from angen_bench import load
    check_folder(args.out)
    load.measure([args.topics] if args.topics else list(load.READERS), args.sensors, args.window,
                 args.out, args.json)
    return 0


def run_bench_soak(args: argparse.Namespace) -> int:
    from angen_bench import soak
    check_folder(args.out)
    soak.measure(args.cycles, args.core, args.out, args.json)
    return 0


def run_bench_homes(args: argparse.Namespace) -> int:
    from angen_bench import homes, tasks
    from angen_tools.common.output import as_json, show
    check_folder(args.out)
    args.out.mkdir(parents=True, exist_ok=True)
    rows = (homes.measure_seeds(args.seeds, args.out) if args.seeds
            else tasks.measure(args.out.absolute(), args.plans) if args.tasks
            else homes.measure(args.out, args.plans))
    show(as_json(rows) if args.json else homes.show_table(rows))
    return 0


def add_commands(commands: Any) -> None:
    """angen bench sensors, core, load, soak and homes."""
    bench = command(commands, 'bench', run_bench, 'measures costs in a node of its own',
                    'bench sensors --kind pir --counts 0,10,50,100')
    kinds = bench.add_subparsers(dest='what', metavar='WHAT', required=True)
    sensors = command(kinds, 'sensors', run_bench, 'measures the cost of sensors: CPU of the node '
                      'and of rviz, speed, readings, memory',
                      'bench sensors --kind pir --counts 0,10,50,100',
                      'bench sensors --mode desired', 'bench sensors --kind pir --vs gazebo')
    sensors.add_argument('--kind', choices=[*KINDS, 'all'], default='all',
                         help='of sensor; all: one after the other (all)')
    sensors.add_argument('--mode', choices=['added', 'deployed', 'both', 'desired'],
                         default='added',
                         help='added: they are in the world when it starts; deployed: spawned '
                         'while it runs; both: one after the other, and all in one figure; '
                         'desired: floors with every sensor that they should have, '
                         'of all kinds (added)')
    sensors.add_argument('--counts', metavar='N,N,…', type=checked(counts),
                         help='of sensors (0,1,10,50,100,200,500), with desired of floors '
                         '(1,2,3,10)')
    sensors.add_argument('--repeats', metavar='N', type=checked(at_least(1, 1000)), default=5,
                         help='of each count; figures are medians (5)')
    sensors.add_argument('--window', metavar='S', type=checked(window), default=5.0,
                         help='how long to measure, in s (5)')
    sensors.add_argument('--vs', choices=['gazebo'], help='measures Gazebo 11 beside it, in a '
                         'chroot of Debian 11 that is made at the first use, as root; a robot '
                         'moves, no person')
    sensors.add_argument('--chroot', metavar='DIR', type=Path, help='where that chroot is '
                         '(~/.cache/angen/gazebo11)')
    add_json(sensors)
    add_out(sensors, 'the CSV files and figures')
    core = command(kinds, 'core', run_bench_core, 'measures the core without ROS: doors, rays, '
                   'PIRs, towers, an hour; some minutes', 'bench core',
                   'bench core --out out --history')
    add_json(core)
    core.add_argument('--history', action='store_true',
                      help='adds the ratios of this version to bench/history.csv')
    add_out(core, 'core.csv')
    load = command(kinds, 'load', run_bench_load, 'measures a node under load: 1,000 sensors, '
                   'subscribers to every topic and one that never reads, 50 commands and 10 spawns '
                   'a second', 'bench load', 'bench load --topics kind --window 60')
    load.add_argument('--topics', choices=['kind', 'sensor'],
                      help='a topic for all sensors of a kind, with 20 subscribers, or one for '
                      'each, with 2 (both, one after the other)')
    load.add_argument('--sensors', metavar='N', type=checked(at_least(1)), default=1000,
                      help='in the world (1000)')
    load.add_argument('--window', metavar='S', type=checked(window), default=60.0,
                      help='how long to measure, in s (60)')
    add_json(load)
    add_out(load, 'load.csv')
    soak = command(kinds, 'soak', run_bench_soak, 'spawns and deletes all kinds again and again in '
                   'a node of its own; ends with 1 where memory grows, or descriptors, threads or '
                   'registrations stay', 'bench soak --cycles 1000', 'bench soak --core')
    soak.add_argument('--cycles', metavar='N', type=checked(at_least(1, 10**9)), default=100_000,
                      help='how often something is spawned and deleted (100000)')
    soak.add_argument('--core', action='store_true', help='the simulator alone, without ROS')
    add_json(soak)
    add_out(soak, 'soak.csv, soak_core.csv')
    imported = command(kinds, 'homes', run_bench_homes, 'imports the nine homes of Debian\'s '
                       'sweethome3d and two scans, and examines them: counts, areas, doors, rays, '
                       'rooms reached',
                       'bench homes', 'bench homes hotel.building.yaml',
                       'bench homes --seeds 200', 'bench homes --tasks')
    imported.add_argument('plans', metavar='PLAN', nargs='*', type=Path, help='examines this '
                          'building.yaml of Open-RMF or map.yaml of map_server, too')
    imported.add_argument('--seeds', metavar='N', type=checked(at_least(1)), default=0,
                          help='examines this number of homes of angen world home instead')
    imported.add_argument('--tasks', action='store_true', help='runs angen demo, seek and care in '
                          'each instead: about an hour')
    add_json(imported)
    add_out(imported, 'the worlds')
