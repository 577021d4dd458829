"""Prints results of commands: tables, JSON. In a terminal tables are rich's and fit its width;
elsewhere a row is one plain line, never cut or wrapped, for grep and the like.
"""
import json
import sys
from typing import TYPE_CHECKING, Any, Callable, Iterable, TextIO

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.table import Table
else:
    Console = RenderableType = Table = object  # commands that print no table start without rich

SEED = 2**53 - 1  # the largest: JSON has no larger whole numbers
ENDLESS = 1_000_000  # columns, more than any table has


def table(head: Iterable[str], rows: Iterable[Iterable[str]], right: Iterable[str] = (),
          one_line: bool = False) -> Table:
    """A table for `show`; columns named in `right` are aligned to the right.

    In a narrow terminal cells are folded, or with `one_line` those of the widest column are cut.
    """
    from rich.table import Table
    from rich.text import Text
    head, lines = list(head), [list(row) for row in rows]
    widths = [max(len(line[i]) for line in [head, *lines]) for i in range(len(head))]
    made = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style='bold')
    for name, width in zip(head, widths):
        made.add_column(Text(name), justify='right' if name in right else 'left',
                        no_wrap=one_line and width < max(widths), overflow='fold')
    for line in lines:
        made.add_row(*(Text(cell, no_wrap=one_line, overflow='ellipsis' if one_line else 'fold')
                       for cell in line))
    return made


def console(file: TextIO, **options: Any) -> Console:
    """rich's console, which takes texts as they are."""
    from rich.console import Console
    return Console(file=file, markup=False, emoji=False, highlight=False, **options)


def plain(thing: RenderableType) -> str:
    """A table or text as lines without color, each whole, without blanks at their ends."""
    from io import StringIO
    text = StringIO()
    console(text, width=ENDLESS, force_terminal=False, color_system=None).print(thing)
    return '\n'.join(line.rstrip() for line in text.getvalue().splitlines())


def show(thing: RenderableType) -> None:
    """Prints a table or text on stdout."""
    if isinstance(thing, str):
        print(thing)
    elif sys.stdout.isatty():
        console(sys.stdout).print(thing)
    else:
        print(plain(thing))


def with_each(value: Any, change: Callable[[Any], Any]) -> Any:
    """JSON data with each value changed that is not a list or a dict."""
    if isinstance(value, dict):
        return {key: with_each(part, change) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [with_each(part, change) for part in value]
    return change(value)


def as_json(value: Any) -> str:
    """The value as JSON to print."""
    return json.dumps(value, indent=1, ensure_ascii=False)


def show_done(done: dict[str, Any], json: bool) -> None:
    """Prints the result of a command: its `text`, or as JSON all but that."""
    print(as_json({key: value for key, value in done.items() if key != 'text'}) if json
          else done['text'])


def number(value: float, places: int = 2) -> str:
    """The number with this many places, never as -0."""
    return f'{round(value, places) + 0.0:.{places}f}'
