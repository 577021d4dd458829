"""angen top: what each device and sensor costs, live."""
from __future__ import annotations

import sys
from contextlib import suppress
from typing import Any

from .client import Client, Mailbox
from .failure import Failure
from .listing import number, table
from .terminal import own_screen, picture, pressed_key

TOPIC = '/angen/cost'
LIMIT = 10.0    # s of wall time for the first message; it comes after about one
REFRESH = 0.25  # s of wall time between two looks for a key
PARTS = ('physics', 'devices', 'sensors', 'commands', 'snapshots', 'publishing')


def head_lines(cost: Any) -> list[str]:
    """What an angen_msgs/Cost says of the whole node."""
    if cost.simulated <= 0:
        return [f'time stands still, for {cost.elapsed:.1f} s now', '']
    core = 100 * cost.process * 1e-6 * cost.simulated / cost.elapsed
    other = max(0.0, cost.process - sum(getattr(cost, part) for part in PARTS))
    parts = ', '.join(f'{part} {getattr(cost, part):.0f}' for part in PARTS)
    return [f'{cost.simulated:.2f} s simulated in {cost.elapsed:.2f} s, at {core:.1f} % of a '
            f'processor; for each simulated second {cost.process:.0f} µs:',
            f'{parts}, other {other:.0f}']


def rows(cost: Any) -> list[list[str]]:
    """Kind, name, µs a simulated second and share of the whole node, the dearest first."""
    share = 100 / cost.process if cost.process > 0 else 0.0
    ranked = sorted(cost.instances, key=lambda i: (-i.cost, i.kind, i.name))
    return [[i.kind, i.name, number(i.cost, 1), f'{number(i.cost * share, 1)} %'] for i in ranked]


def lines(cost: Any) -> tuple[list[str], list[str]]:
    """(what stands above the table and its head, the table's other lines)."""
    head, *body = table(('KIND', 'NAME', 'µs/s', 'SHARE'), rows(cost)).splitlines()
    return [*head_lines(cost), head], body


class Meter:
    """The latest message of the simulator's meter, which runs while this lives."""

    def __init__(self) -> None:
        from angen_msgs.msg import Cost
        self._mail = Mailbox(Client())
        self._mail.listen(TOPIC, Cost)
        self._mail.connected(TOPIC)
        self.cost: Any = None

    def hear(self, limit: float) -> bool:
        """True when there is a new message within `limit` s of wall time."""
        mail = self._mail.get(limit)
        if mail is None:
            return False
        self.cost = mail[1]
        return True


def top_once() -> str:
    """The costs of one second or so."""
    meter = Meter()
    if not meter.hear(LIMIT):
        raise Failure(f'{TOPIC} has told nothing within {LIMIT:g} s')
    head, body = lines(meter.cost)
    return '\n'.join([*head, *body])


def top() -> None:
    """Draws the costs anew until q or Ctrl-C, space turns the page; one table where stdout is no
    terminal."""
    if not sys.stdin.isatty() or not sys.stdout.isatty():
        print(top_once())
        return
    meter = Meter()
    page = 0
    with own_screen(), suppress(KeyboardInterrupt):
        sys.stdout.write(picture(['measuring …'], [], 0))
        sys.stdout.flush()
        while (key := pressed_key()) not in ('q', 'Q'):
            page += key == ' '
            if not meter.hear(REFRESH) and not (key and meter.cost):
                continue
            sys.stdout.write(picture(*lines(meter.cost), page))
            sys.stdout.flush()
