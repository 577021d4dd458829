"""angen generate, validate and realism on the command line."""
import argparse
import os
from pathlib import Path
from typing import Any

from angen_apps.data.shapes import DAYS, YEARS
from angen_tools.cli.arguments import at_least, checked
from angen_tools.cli.parser import add_json, add_out, add_seed, add_world_file, command
from angen_tools.common.failure import Failure

NAMES = ('casas', 'casas-columns', 'aras', 'kasteren', 'openshs', 'csv', 'parquet', 'xes', 'power')


def formats(text: str) -> tuple[str, ...]:
    """Formats between commas."""
    from angen_tools.common.nearest import did_you_mean
    words = [word.strip() for word in text.split(',')]
    for word in words:
        if word not in NAMES:
            raise ValueError(f"'{word}' is not a format; {did_you_mean(word, NAMES)}")
    return tuple(dict.fromkeys(words))


def date(text: str) -> str:
    import datetime
    try:
        found = datetime.date.fromisoformat(text)
    except ValueError:
        raise ValueError(f"'{text}' is not a date as 2026-03-23") from None
    if not YEARS[0] <= found.year <= YEARS[1]:
        raise ValueError(f"'{text}' is not in the years {YEARS[0]} to {YEARS[1]}")
    return found.isoformat()


def residents(text: str) -> tuple[str, ...]:
    """A number of residents, or profiles between commas."""
    words = tuple(word.strip() for word in text.split(','))
    for word in words:
        if not word:
            raise ValueError('a name is missing; give a number, or profiles between commas')
        if not word.isdecimal() and word.lstrip('+-').replace('.', '', 1).isdecimal():
            raise ValueError(f"'{word}' is not a number of residents")
    return words


def run_generate(args: argparse.Namespace) -> int:
    from angen_apps.data.generate import Job, generate
    job = Job(str(args.out), 'home', args.seed, args.days, args.residents, args.format,
              args.start or '', str(args.world or ''), str(args.faults or ''), args.light,
              args.own_sensors, args.strict)
    entries = generate(job, args.homes, args.processes, args.scheduler)
    if args.json:
        from angen_tools.common.output import as_json
        print(as_json(entries))
        return 0
    for entry in entries[:20]:
        who = ', '.join(f'{name} ({profile})' for name, profile in entry['residents'])
        print(f'{entry["name"]}: {entry["events"]} events of {entry["sensors"]} sensors; {who}')
    if len(entries) > 20:
        print(f'and {len(entries) - 20} more')
    return 0


def run_validate(args: argparse.Namespace) -> int:
    from angen_apps.data.validate import SHOWN, validate_all
    from angen_tools.common.output import as_json, show, table
    every, shares = validate_all(args.folder, args.world)
    if args.json:
        print(as_json({'findings': every.wrong, 'checked': dict(every.checked), 'shares': shares}))
    else:
        show(table(('check', 'checked', 'findings'),
                   [(check, str(every.checked[check]), str(len(wrong)))
                    for check, wrong in every.wrong.items()], ('checked', 'findings')))
        show(table(('home', 'explained', 'noise', 'missed'),
                   [(home, *(f'{100 * share:.2f} %' for share in found.values()))
                    for home, found in shares.items()], ('explained', 'noise', 'missed')))
        for check, wrong in every.wrong.items():
            for line in wrong[:SHOWN]:
                print(f'{check}: {line}')
    return 1 if every.count else 0


def run_realism(args: argparse.Namespace) -> int:
    from angen_apps.data import realism
    from angen_apps.data.tables import homes
    from angen_tools.common.output import as_json, show, table
    paths = [args.folder] if args.folder.is_file() else homes(args.folder)
    stream = realism.read(paths[0])
    reference = realism.read(args.against) if args.against else None
    found = realism.compare(stream, reference)
    spans = {name: sorted(values)[len(values) // 2] / 60
             for name, values in realism.durations(stream).items()}
    scores: list[tuple[str, float]] = []
    if args.rooms and not args.transfer:
        raise Failure('--rooms needs --transfer')
    if args.transfer:
        from angen_apps.data.transfer import transfer
        scores = transfer(paths, args.transfer, args.rooms)
    if args.json:
        print(as_json({'measures': [dict(zip(('name', 'value', 'reference', 'verdict'), row))
                                    for row in found], 'median minutes': spans,
                       'macro F1': dict(scores)}))
    else:
        show(table(('measure', 'data', 'reference', ''),
                   [(name, f'{value:.4g}', other, verdict) for name, value, other, verdict
                    in found], ('data',)))
        show(table(('activity', 'median, min'), [(name, f'{value:.1f}')
                                                 for name, value in sorted(spans.items())],
                   ('median, min',)))
    if scores and not args.json:
        show(table(('learned from', 'macro F1 on later days'),
                   [(name, f'{score:.2f}') for name, score in scores],
                   ('macro F1 on later days',)))
    if args.figure:
        realism.figure(stream, reference, args.figure)
    return 0


def add_strict(parser: argparse.ArgumentParser) -> None:
    """--strict, of commands that say what residents cannot do in a home."""
    parser.add_argument('--strict', action='store_true', help='exit code 1 if the home has no '
                        'place for something that residents do; otherwise they leave it out')


def add_household(commands: Any) -> None:
    """angen home --residents."""
    home = commands.choices['home']
    home.add_argument('--residents', metavar='WHO', type=checked(residents), default=(),
                      help='a number, or profiles between commas: says what they cannot do there')
    add_strict(home)
    described = home.get_default('run')

    def run_home(args: argparse.Namespace) -> int:
        result = int(described(args))
        if args.residents or args.strict:
            from angen_apps.data.run import try_household
            try_household(Path(args.world), list(args.residents or ('2',)), args.strict)
        return result
    home.set_defaults(run=run_home)


def add_generate(commands: Any) -> None:
    """angen generate."""
    made = command(commands, 'generate', run_generate,
                   'has residents live in homes and writes labeled data of their sensors; needs '
                   'no simulator', 'generate --days 2 --residents 2 --seed 7 --format casas',
                   'generate --homes 20 --days 30 --residents 3 --format casas,csv --out homes')
    made.add_argument('--days', metavar='N', type=checked(at_least(1, DAYS)), default=1,
                      help='days of each home (1)')
    made.add_argument('--residents', metavar='WHO', type=checked(residents), default=('2',),
                      help='a number, or profiles between commas: retired, worker, student, … or '
                      'YAML files, as docs/data.md describes them (2)')
    add_seed(made, 'of the habits of residents and of all noise')
    made.add_argument('--format', metavar='LIST', type=checked(formats), default=('casas',),
                      help=f'formats between commas: {", ".join(NAMES)} (casas)')
    made.add_argument('--start', metavar='DATE', type=checked(date),
                      help="the first day (that of the home's description)")
    add_world_file(made, 'a home of your own that describes its rooms')
    made.add_argument('--own-sensors', action='store_true',
                      help="uses the world's sensors and adds none")
    made.add_argument('--light', action='store_true', help='adds a light sensor to each room; slow')
    made.add_argument('--faults', metavar='FILE', type=Path,
                      help='a YAML file of faults of sensors, as docs/data.md describes it')
    add_strict(made)
    made.add_argument('--homes', metavar='N', type=checked(at_least(1, 100_000)), default=1,
                      help='homes, each in a folder of its own (1)')
    made.add_argument('--processes', metavar='N', type=checked(at_least(1, 1000)),
                      default=os.cpu_count() or 1, help='homes at a time (one a core)')
    made.add_argument('--scheduler', metavar='ADDRESS', default='',
                      help='of a Dask cluster whose workers see the output folder')
    add_json(made)
    add_out(made, 'the data')


def add_validate(commands: Any) -> None:
    """angen validate."""
    made = command(commands, 'validate', run_validate,
                   'checks the data of angen generate against walls, rooms, seats and causes',
                   'validate out')
    made.add_argument('folder', metavar='DIR', type=Path, help='output folder of angen generate')
    made.add_argument('world', metavar='WORLD', nargs='?', type=Path,
                      help='the home of your own that the data are of: compares the layout, too')
    add_json(made)


def add_realism(commands: Any) -> None:
    """angen realism."""
    made = command(commands, 'realism', run_realism,
                   'compares data with figures of real homes, or with a file of CASAS',
                   'realism out', 'realism out --against aruba.txt --figure realism.png',
                   'realism out --transfer aruba.txt')
    made.add_argument('folder', metavar='DIR', type=Path,
                      help='output folder of angen generate, or a file of CASAS')
    made.add_argument('--against', metavar='FILE', type=Path, help='a reference: such a file')
    made.add_argument('--transfer', metavar='FILE', type=Path, help='a real home with labels: how '
                      'well a classifier knows its activities that learned from the data')
    made.add_argument('--rooms', metavar='FILE', type=Path, help='lines of a sensor of that home '
                      'and the use of its room; otherwise by its labels')
    made.add_argument('--figure', metavar='FILE', type=Path, help='also draws it')
    add_json(made)
