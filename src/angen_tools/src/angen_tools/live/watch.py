"""angen watch: every sensor and device, live."""
import sys
import time
from contextlib import suppress
from typing import Sequence

from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.output import RenderableType, as_json, table
from angen_tools.common.shown import values_of
from angen_tools.live.summary import Board, Filter, Row
from angen_tools.session.live import Live

REFRESH = 0.25  # s of wall time between two pictures
MARGIN = 0.5    # simulated s over its period in which a sensor's first reading comes
LIMIT = 120.0   # s of wall time after which a slow simulation is not waited for
WIDEST = 120     # characters of a value that a table shows
HEAD = ('KIND', 'NAME', 'VALUE', 'TIME, s')


def watch_once(rule: Filter, json: bool = False) -> tuple[RenderableType, str]:
    """The last reading of each sensor and device, and the name of a missing one, '' without one.

    Waits for the first reading of each sensor up to its period of simulated time.
    """
    board = Board(Live())
    check(board, rule)
    silent = _wait(board, rule)
    rows = board.chosen(rule)
    if json:
        return as_json([_as_dict(row) for row in rows]), _missing(board, silent)
    return table(HEAD, map(_cells, rows)), _missing(board, silent)


def _wait(board: Board, rule: Filter) -> list[Row]:
    """Waits for first readings; the sensors that have sent none within their period."""
    start, end = board.time, time.monotonic() + LIMIT
    while True:
        waiting = [row for row in board.rows.values()
                   if row.waits and rule.passes(row.kind, row.name, row.room)]
        late = [row for row in waiting if board.time > start + row.period + MARGIN]
        if len(late) == len(waiting) or board.paused or time.monotonic() > end:
            return waiting
        board.receive(REFRESH)


def _missing(board: Board, silent: Sequence[Row]) -> str:
    if not silent:
        return ''
    names = ', '.join(f'{row.kind} {row.name}' for row in silent[:3])
    more = f' and {len(silent) - 3} more' if len(silent) > 3 else ''
    why = 'the simulation is paused' if board.paused else 'their period has passed'
    return f'no reading of {names}{more}: {why}'


def check(board: Board, rule: Filter) -> None:
    """Failure if a filter has an unknown name."""
    names = {name for _, name in board.rows}
    for name in rule.names:
        if name not in names:
            meant = (f'did you mean --kind {name}?' if name in kinds()
                     else did_you_mean(name, names, 'angen watch --once'))
            raise Failure(f"no sensor or device named '{name}'; {meant}")
    if rule.room and not any(Filter(room=rule.room).passes(row.kind, row.name, row.room)
                             for row in board.rows.values()):
        rooms = {row.room for row in board.rows.values() if row.room}
        raise Failure(f"no sensor or device is in a room '{rule.room}'; "
                      + did_you_mean(rule.room, rooms))
    known = {kind for kind, _ in board.rows} | set(kinds())
    for kind in rule.kinds:
        if ',' in kind and all(one in known for one in kind.split(',')):
            raise Failure('--kind takes one kind; did you mean '
                          + ' '.join(f'--kind {one}' for one in kind.split(',')) + '?')
        if kind not in known:
            raise Failure(f"there is no kind '{kind}'; "
                          + did_you_mean(kind, known, 'angen plugins'))


def _cells(row: Row) -> list[str]:
    text = f'{row.place}, by its wheels {row.text}' if row.place and row.text else row.text
    text = text if len(text) <= WIDEST else text[:WIDEST - 1] + '…'
    return [row.kind, row.name, text or '-', f'{row.time:.1f}' if row.text else '']


def _as_dict(row: Row) -> dict[str, object]:
    return {'kind': row.kind, 'name': row.name, 'value': row.text,
            'values': values_of(kinds().get(row.kind), row.text), 'alarm': row.alarm,
            'time': row.time if row.text else None}


def watch(rule: Filter) -> None:
    """Redraws the table until q or Ctrl-C; space turns its pages."""
    from angen_tools.common.terminal import LiveTable
    if not sys.stdin.isatty() or not sys.stdout.isatty():
        raise Failure('a live table needs a terminal; use --once for one table')
    board = Board(Live())
    check(board, rule)
    with LiveTable() as screen, suppress(KeyboardInterrupt):
        while not screen.closed():
            rows = board.chosen(rule)
            screen.draw(title(board, rows), HEAD, list(map(_cells, rows)), right=HEAD[3:])
            _receive(board)


def _receive(board: Board) -> None:
    """Handles all messages until the next picture."""
    end = time.monotonic() + REFRESH
    while (left := end - time.monotonic()) > 0:
        board.receive(left)


def title(board: Board, rows: Sequence[Row]) -> str:
    """The number of rows, and their time."""
    alarms = sum(row.alarm for row in rows)
    parts = [f'{len(rows)} of {len(board.rows)} sensors and devices', f'{alarms} detecting',
             f'{board.time:.1f} s simulated']
    return ', '.join(parts + ['paused'] * board.paused)
