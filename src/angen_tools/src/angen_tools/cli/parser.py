"""The parts that the subcommands of angen are made of."""
import argparse
import re
import sys
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Callable, NoReturn

from angen_tools.cli.arguments import at_least, checked, path
from angen_tools.common.catalog import kinds
from angen_tools.common.nearest import asked, did_you_mean, nearest
from angen_tools.common.output import SEED

Run = Callable[[argparse.Namespace], int]  # executes the command; returns the exit code
# Other words for kinds and commands, which no likeness of letters finds.
MEANT = {'light': 'lamp', 'bulb': 'lamp', 'lift': 'elevator', 'oven': 'stove', 'cooker': 'stove',
         'radiator': 'heater', 'robot': 'drive', 'human': 'person', 'motion': 'pir',
         'lux': 'luminosity', 'touch': 'contact', 'start': 'run', 'launch': 'run',
         'simulate': 'run', 'add': 'spawn', 'remove': 'delete', 'rm': 'delete', 'ls': 'list',
         'show': 'watch', 'status': 'watch', 'move': 'go', 'open': 'set', 'close': 'set'}
# Commands of ./angen, which angen itself has not.
ENTRY = ('demo', 'shell', 'build', 'test', 'fuzz', 'coverage', 'tidy', 'docs')
ALIKE = 0.75  # likeness of an option and the one that was meant
EXPLICIT = re.compile("ignored explicit argument '.*'")  # argparse's error for --json=yes
NEGATIVE = re.compile(r'-\.?\d.*')  # -1.57 and -90deg are values, no options


class Parser(argparse.ArgumentParser):
    """Reports an error in the words in one line."""

    kinds: Any = None  # the subcommands to which other packages add

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._negative_number_matcher = NEGATIVE
        self.register('type', Path, checked(path))

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Reports words that are too many with the subcommand that they follow."""
        found, extra = super().parse_known_args(args, namespace)
        if extra:
            self.error(f'unrecognized arguments: {" ".join(extra)}{self._meant(extra[0])}')
        return found, extra

    def _meant(self, word: str) -> str:
        """The option that a word was meant to be, for the end of an error."""
        option = word.partition('=')[0]
        for action in self._actions:
            if not action.option_strings and option == f'--{str(action.metavar).lower()}':
                return f'; give {action.metavar} without {option}'
        likely = get_close_matches(option, self._option_string_actions, 1, ALIKE)
        if '--kind' in self._option_string_actions and word in kinds():
            likely = [f'--kind {word}']
        return f'; did you mean {likely[0]}?' if likely else ''

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """argparse's own check, which lists every choice there is."""
        if action.choices is not None and value not in action.choices:
            word = str(value)
            one = word.removesuffix('s')
            meant = MEANT.get(word, MEANT.get(one, one if one in kinds() else word))
            question = (f'did you mean {meant}?' if meant in action.choices
                        else self._other_role(meant) or self._elsewhere(word, action)
                        or did_you_mean(word, action.choices))
            raise argparse.ArgumentError(action, f"'{value}' is not known; {question}")

    def _other_role(self, kind: str) -> str:
        """The fix for spawning a device or setting a sensor."""
        if self.prog == 'angen spawn' and kind in kinds('device'):
            models = [entry['model'] for entry in kinds()[kind]['models']] or ['MODEL']
            return f'a {kind} comes with its model: angen spawn model {models[0]} NAME'
        if self.prog == 'angen set' and kind in kinds('sensor'):
            return f'a {kind} is a sensor, which takes no commands; angen watch shows it'
        return ''

    def _elsewhere(self, word: str, action: argparse.Action) -> str:
        """The command that was meant: one of ./angen, too, or the one that a word follows, as seek
        follows task."""
        if self.prog != 'angen' or not isinstance(action.choices, dict):
            return ''
        outer = [f'{name} {word}' for name, inner in action.choices.items()
                 for part in inner._actions if not part.option_strings
                 and word in (part.choices or ())]
        near = [f'./angen {name}' if name in ENTRY else name
                for name in nearest(word, [*action.choices, *ENTRY])]
        return asked(outer or near)

    def error(self, message: str) -> NoReturn:
        message = EXPLICIT.sub('takes no value', message)
        self.exit(2, f'{self.prog}: {message}; see {self.prog} --help\n')


class Given(argparse.Action):
    """A word that may be missing: then the former option may have set its value."""

    def __call__(self, parser: argparse.ArgumentParser, namespace: argparse.Namespace,
                 values: Any, option: str | None = None) -> None:
        if values is not None:
            setattr(namespace, self.dest, values)


class Former(argparse.Action):
    """The former spelling of an option, for one release: a warning, then its value as before."""

    def __call__(self, parser: argparse.ArgumentParser, namespace: argparse.Namespace,
                 values: Any, option: str | None = None) -> None:
        print(f'{parser.prog}: {option} is now {self.metavar}', file=sys.stderr)
        setattr(namespace, self.dest, values)


def former(parser: Parser, option: str, now: str, dest: str, kind: Any = Path) -> None:
    """Accepts the former spelling of an option, which the help does not show."""
    parser.add_argument(option, action=Former, metavar=now, dest=dest, type=kind,
                        default=argparse.SUPPRESS, help=argparse.SUPPRESS)


def command(commands: Any, name: str, run: Run, summary: str, *examples: str, more: str = ''
            ) -> Parser:
    """Adds a subcommand whose help ends with examples, and `more`."""
    parser: Parser = commands.add_parser(
        name, help=summary, description=summary[0].upper() + summary[1:] + '.' * (
            not summary.endswith(('.', '…'))),
        epilog='example:\n' + '\n'.join(f'  angen {example}' for example in examples)
        + f'\n\n{more}' * bool(more),
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.set_defaults(run=run)
    return parser


def add_json(parser: Parser) -> None:
    """The option of every command that prints a table."""
    parser.add_argument('--json', action='store_true', help='prints JSON')


def add_seed(parser: Parser, text: str, default: int = 1) -> None:
    """The option of every command whose result depends on random numbers."""
    parser.add_argument('--seed', metavar='S', type=checked(at_least(0, SEED)), default=default,
                        help=f'seed {text} ({default})')


def add_world_file(parser: Parser, text: str, required: bool = False, kind: Any = Path) -> None:
    """The world of a command; without one it is the running simulator or the built-in world."""
    if required:
        parser.add_argument('world', metavar='WORLD', type=kind, help=text)
        return
    parser.add_argument('world', metavar='WORLD', nargs='?', type=Path, action=Given, help=text)
    former(parser, '--world', 'WORLD, without an option', 'world')


def add_file(parser: Parser, text: str = 'the world that is written', metavar: str = 'FILE',
             default: Path | None = None) -> None:
    """The file that a command writes."""
    parser.add_argument('-o', '--output', metavar=metavar, type=Path, default=default,
                        required=default is None, help=text)


def add_out(parser: Parser, what: str) -> None:
    """The folder in which a command leaves files."""
    parser.add_argument('--out', metavar='DIR', type=Path, default=Path('out'),
                        help=f'folder for {what} (out)')
    former(parser, '-o', '--out', 'out')


def add_allow_paths(parser: Parser) -> None:
    """The option of every command that loads a world or a model into its own process."""
    parser.add_argument('--allow-paths', action='store_true',
                        help='models may name files and plug-in libraries anywhere')
