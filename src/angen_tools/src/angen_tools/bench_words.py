"""The words of angen world and angen bench; what they do is loaded when they are said."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Callable

from .failure import Failure

KINDS = ('pir', 'switch', 'luminosity', 'contact')
MOVERS = ('person', 'robot', 'nobody')


def at_least(least: int) -> Callable[[str], int]:
    """A whole number that is not below `least`; ValueError says so."""
    def whole(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if number < least:
            raise ValueError(f"'{text}' is no whole number of at least {least}")
        return number
    return whole


def seconds(text: str) -> float:
    """A length of time of 1 s or more; ValueError where it is none."""
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not 1.0 <= number <= 3600.0:
        raise ValueError(f"'{text}' is no time; give 1 to 3600 s")
    return number


def counts(text: str) -> list[int]:
    """Numbers between commas; ValueError says which is none."""
    return [at_least(0)(word.strip()) for word in text.split(',')]


def run_world(args: argparse.Namespace) -> int:
    from . import world_maker
    sensors = world_maker.write_apartment(
        args.output, args.floors, {kind: getattr(args, kind) for kind in KINDS}, args.seed,
        args.elevator, args.mover, args.one_link)
    print(f'wrote {args.output}: {args.floors} floor{"s"[:args.floors > 1]}, {sensors} sensors')
    return 0


def run_bench(args: argparse.Namespace) -> int:
    from . import bench
    if args.vs:
        from . import bench_contest
        if args.mode != 'added':
            raise Failure('--vs compares sensors that are there at the start: give --mode added')
        bench_contest.measure(bench.cases('added', args.kind, args.counts, 'robot'), args.repeats,
                              args.window, args.out, args.chroot)
    else:
        bench.measure(bench.cases(args.mode, args.kind, args.counts), args.repeats, args.window,
                      args.out)
    return 0


def run_bench_core(args: argparse.Namespace) -> int:
    from . import bench_core
    bench_core.measure(args.out)
    return 0


def add_world(commands: Any, command: Callable[..., argparse.ArgumentParser],
              checked: Callable[[Any], Any]) -> None:
    """angen world apartment."""
    world = command(commands, 'world', run_world, 'writes a world; needs no simulator',
                    'world apartment --floors 2 --pir 50 -o out.world')
    kinds = world.add_subparsers(dest='what', metavar='WHAT', required=True)
    flat = command(kinds, 'apartment', run_world, 'writes flats, one above the other, with sensors',
                   'world apartment --floors 2 --pir 50 --switch 12 -o out.world')
    flat.add_argument('--floors', metavar='N', type=checked(at_least(1)), default=2,
                      help='how many flats (2)')
    for kind in KINDS:
        flat.add_argument(f'--{kind}', metavar='N', type=checked(at_least(0)), default=0,
                          help=f'how many {kind} sensors' +
                          (', each with its chair or table (0)' if kind == 'contact' else ' (0)'))
    flat.add_argument('--elevator', action='store_true',
                      help='with the elevator, which holds one of the contact sensors')
    flat.add_argument('--mover', choices=MOVERS, default='person', help='who is on floor 0: '
                      'a person who walks; a robot, which drives in the workroom when it is sent '
                      '(person)')
    flat.add_argument('--one-link', action='store_true',
                      help='puts all sensors of a kind on one link, not each in its own model; '
                      'contact sensors stay on the furniture')
    flat.add_argument('--seed', metavar='S', type=checked(at_least(0)), default=1,
                      help='of the places that are left to chance (1)')
    flat.add_argument('-o', '--output', metavar='FILE', type=Path, required=True)


def add_bench(commands: Any, command: Callable[..., argparse.ArgumentParser],
              checked: Callable[[Any], Any]) -> None:
    """angen bench sensors, angen bench core."""
    bench = command(commands, 'bench', run_bench, 'measures what things cost; starts its own node',
                    'bench sensors --kind pir --counts 0,10,50,100')
    kinds = bench.add_subparsers(dest='what', metavar='WHAT', required=True)
    sensors = command(kinds, 'sensors', run_bench, 'measures what sensors cost: CPU of the node '
                      'and of rviz, speed, readings, memory',
                      'bench sensors --kind pir --counts 0,10,50,100',
                      'bench sensors --mode desired', 'bench sensors --kind pir --vs gazebo')
    sensors.add_argument('--kind', choices=[*KINDS, 'all'], default='all',
                         help='of sensor; all: one after the other (all)')
    sensors.add_argument('--mode', choices=['added', 'deployed', 'desired'], default='added',
                         help='added: they are in the world when it starts; deployed: spawned '
                         'while it runs; desired: flats with every sensor that they should have, '
                         'of all kinds (added)')
    sensors.add_argument('--counts', metavar='N,N,…', type=checked(counts),
                         help='of sensors (0,1,10,50,100,200,500), with desired of flats '
                         '(1,2,3,10)')
    sensors.add_argument('--repeats', metavar='N', type=checked(at_least(1)), default=3,
                         help='of each count; figures are medians (3)')
    sensors.add_argument('--window', metavar='S', type=checked(seconds), default=5.0,
                         help='how long to measure, in s (5)')
    sensors.add_argument('--vs', choices=['gazebo'], help='measures Gazebo 11 beside it, in a '
                         'chroot of Debian 11 that is made at the first use, as root; a robot '
                         'moves, no person')
    sensors.add_argument('--chroot', metavar='DIR', type=Path, help='where that chroot is '
                         '(~/.cache/angen/gazebo11)')
    sensors.add_argument('-o', '--out', metavar='DIR', type=Path, default=Path('out'),
                         help='where the CSV files and figures go (out)')
    core = command(kinds, 'core', run_bench_core, 'measures the core without ROS: doors, rays, '
                   'PIRs, towers, an hour; some minutes', 'bench core', 'bench core -o out')
    core.add_argument('-o', '--out', metavar='DIR', type=Path, default=Path('out'),
                      help='where core.csv goes (out)')
