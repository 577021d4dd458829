"""A terminal whose keys come one by one, and pictures that fill it."""
from __future__ import annotations

import math
import os
import select
import shutil
import sys
import termios
import tty
from contextlib import contextmanager
from typing import Iterator, Sequence


@contextmanager
def single_keys() -> Iterator[None]:
    """Keys of stdin come one by one and unseen; all is put back at the end, however it ends."""
    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setcbreak(sys.stdin)
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


@contextmanager
def own_screen() -> Iterator[None]:
    """Keys come one by one and unseen, on a screen of its own; all is put back at the end."""
    with single_keys():
        try:
            sys.stdout.write('\x1b[?1049h\x1b[?25l')
            yield
        finally:
            sys.stdout.write('\x1b[?25h\x1b[?1049l')
            sys.stdout.flush()


def pressed_key() -> str:
    """A key that was pressed, "" if none was."""
    ready = select.select([sys.stdin], [], [], 0)[0]
    return os.read(sys.stdin.fileno(), 1).decode(errors='replace') if ready else ''


def picture(head: Sequence[str], body: Sequence[str], page: int) -> str:
    """What draws `head` and as many lines of `body` as fit under it, page by page."""
    size = shutil.get_terminal_size()
    rows = max(1, size.lines - 1 - len(head))
    pages = max(1, math.ceil(len(body) / rows))
    first = page % pages * rows
    turn = f'page {page % pages + 1} of {pages}: space turns it; ' if pages > 1 else ''
    shown = [line[:size.columns] for line in [*head, *body[first:first + rows]]]
    return '\x1b[H' + ''.join(f'{line}\x1b[K\n' for line in shown) + f'\x1b[J{turn}q quits'


class Progress:
    """A line that says how far it is, where somebody looks."""

    def __init__(self, what: str) -> None:
        self._what = what

    def say(self, share: float) -> None:
        if sys.stderr.isatty():
            print(f'\r\033[K{self._what}: {100 * share:.0f} %', end='', file=sys.stderr, flush=True)

    def end(self) -> None:
        if sys.stderr.isatty():
            print('\r\033[K', end='', file=sys.stderr, flush=True)
