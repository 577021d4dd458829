"""A terminal whose keys come one by one, and a live table that fills it."""
import math
import os
import select
import sys
import termios
import tty
from contextlib import contextmanager
from typing import Iterator, Self, Sequence

from angen_tools.common.output import console, table

CTRL_C = '\x03'
NO_KEY = b'\0'  # no key has this function


@contextmanager
def single_keys() -> Iterator[None]:
    """Keys of stdin come one by one, without echo; the terminal is restored at the end.

    Ctrl-C is a key, too: an exception in the midst of a library's locks could lose more.
    """
    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setcbreak(sys.stdin)
        keys = termios.tcgetattr(sys.stdin)
        keys[6][termios.VINTR] = NO_KEY
        termios.tcsetattr(sys.stdin, termios.TCSANOW, keys)
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def pressed_key() -> str:
    """A key that was pressed, "" if none was."""
    ready = select.select([sys.stdin], [], [], 0)[0]
    return os.read(sys.stdin.fileno(), 1).decode(errors='replace') if ready else ''


class LiveTable:
    """A table on a screen of its own, page by page. A context: its end restores the terminal."""

    def __init__(self) -> None:
        from rich.live import Live
        self._console = console(sys.stdout)
        self._live = Live(console=self._console, screen=True, auto_refresh=False)
        self._keys = single_keys()
        self._page = 0

    def __enter__(self) -> Self:
        self._keys.__enter__()
        self._live.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        try:
            self._live.__exit__(None, None, None)
        finally:
            self._keys.__exit__(None, None, None)

    def closed(self) -> bool:
        """Whether q or Ctrl-C was pressed; space turns the page."""
        key = pressed_key()
        self._page += key == ' '
        return key in ('q', 'Q', CTRL_C)

    def draw(self, title: str, head: Sequence[str], rows: Sequence[Sequence[str]],
             right: Sequence[str] = ()) -> None:
        """Shows `title` and as many rows as fit under it."""
        from rich.console import Group
        from rich.text import Text
        above = Text(title)
        taken = len(self._console.render_lines(above)) if title else 0
        fitting = max(1, self._console.height - taken - 2)
        pages = max(1, math.ceil(len(rows) / fitting))
        page = self._page % pages
        turn = f'page {page + 1} of {pages}: space turns it; ' if pages > 1 else ''
        self._live.update(Group(
            *([above] if title else []),
            table(head, rows[page * fitting:(page + 1) * fitting], right, one_line=True),
            Text(f'{turn}q quits')), refresh=True)
