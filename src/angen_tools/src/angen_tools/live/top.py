"""angen top: the costs of each device and sensor, live."""
import sys
from contextlib import suppress
from typing import Any

from angen_tools.common.failure import Failure
from angen_tools.common.output import RenderableType, as_json, number, plain, table
from angen_tools.session.live import Live

TOPIC = 'angen/cost'
LIMIT = 10.0    # s of wall time for the first message; it comes after about one
REFRESH = 0.25  # s of wall time between two checks for a key
PARTS = ('physics', 'devices', 'sensors', 'commands', 'snapshots', 'publishing', 'network')
HEAD = ('KIND', 'NAME', 'µs/s', 'SHARE')


def title(cost: Any) -> str:
    """The costs of the whole node in an angen_msgs/Cost."""
    if cost.simulated <= 0:
        return f'the simulation has not advanced for {cost.elapsed:.1f} s\n'
    core = 100 * cost.process * 1e-6 * cost.simulated / cost.elapsed
    other = max(0.0, cost.process - sum(getattr(cost, part) for part in PARTS))
    parts = ', '.join(f'{part} {getattr(cost, part):.0f}' for part in PARTS)
    return (f'{cost.simulated:.2f} s simulated in {cost.elapsed:.2f} s, at {core:.1f} % of a '
            f'processor; for each simulated second {cost.process:.0f} µs:\n'
            f'{parts}, the rest {other:.0f}')


def rows(cost: Any) -> list[list[str]]:
    """Kind, name, µs a simulated second and share of the whole node, the most expensive first."""
    share = 100 / cost.process if cost.process > 0 else 0.0
    ranked = sorted(cost.instances, key=lambda i: (-i.cost, i.kind, i.name))
    return [[i.kind, i.name, number(i.cost, 1), f'{number(i.cost * share, 1)} %'] for i in ranked]


def as_dict(cost: Any) -> dict[str, Any]:
    """The same for JSON, in µs per simulated second."""
    return {'units': {'simulated': 's', 'elapsed': 's', 'others': 'us per simulated s'},
            'simulated': cost.simulated, 'elapsed': cost.elapsed, 'process': cost.process,
            **{part: getattr(cost, part) for part in PARTS},
            'instances': [{'kind': i.kind, 'name': i.name, 'cost': i.cost}
                          for i in cost.instances]}


class Meter:
    """The latest message of the simulator's meter, which runs while this lives."""

    def __init__(self) -> None:
        from angen_msgs.msg import Cost
        self._world = Live()
        self._inbox = self._world.subscribe(TOPIC, Cost)
        self._inbox.connect()
        self.cost: Any = None

    def receive(self, limit: float) -> bool:
        """True when there is a new message within `limit` s of wall time."""
        before, inbox = self.cost, self._inbox
        came = self._world.until(lambda: inbox.latest is not before, limit)
        self.cost = inbox.latest
        return came


def top_once(json: bool = False) -> RenderableType:
    """The costs of one second or so."""
    meter = Meter()
    if not meter.receive(LIMIT):
        raise Failure(f'no message came on {TOPIC} within {LIMIT:g} s')
    if json:
        return as_json(as_dict(meter.cost))
    return f'{title(meter.cost)}\n{plain(table(HEAD, rows(meter.cost)))}'


def top() -> None:
    """Draws the costs until q or Ctrl-C, space turns the page; one table where stdout is not
    a terminal."""
    from angen_tools.common.terminal import LiveTable
    if not sys.stdin.isatty() or not sys.stdout.isatty():
        print(top_once())
        return
    meter = Meter()
    with LiveTable() as screen, suppress(KeyboardInterrupt):
        screen.draw('measuring …', (), ())
        while not screen.closed():
            if meter.receive(REFRESH) or meter.cost:
                screen.draw(title(meter.cost), HEAD, rows(meter.cost), HEAD[2:])
