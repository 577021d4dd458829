"""A simulated day: commands to devices at times of day, from a CSV file."""
import csv
import io
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Sequence

from angen_tools.common.catalog import kind_of, simulator
from angen_tools.common.clock import DAY, time_of_day
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.text_file import read_text, separator_hint
from angen_tools.common.verbs import parse

COLUMNS = ['time', 'target', 'command']


@dataclass(frozen=True)
class Order:
    """A command to the device `kind`/`name` at a time, s of simulated time."""

    time: float
    kind: str
    name: str
    text: str
    where: str  # file:line

    def execute(self, world: Any) -> None:
        """Commands an angen.World; Failure if it rejects."""
        with simulator(f'{self.where}: '):
            world.command(self.kind, self.name, self.text)


def checked_orders(world: Any, orders: Sequence[Order]) -> list[Order]:
    """The orders in the words that the simulator takes; Failure if a world has not the device
    of one, or that does not take its words."""
    found = []
    for order in orders:
        try:
            kind = kind_of(order.kind)
            names = [*world.devices(order.kind), 'all']
            if order.name not in names:
                raise Failure(f"no {order.kind} is named '{order.name}'; "
                              + did_you_mean(order.name, names))
            found.append(replace(order, text=parse(kind, order.text.split()).text))
        except (Failure, ValueError) as error:
            raise Failure(f'{order.where}: {error}') from None
    return found


def read_day(path: Path, starts: float) -> list[Order]:
    """The commands of a file in the order of their times, the first after the start of the day."""
    orders = []
    lines = csv.reader(io.StringIO(read_text(path), newline=''), skipinitialspace=True)
    head: list[str] = next(lines, [])
    if head != COLUMNS:
        raise Failure(f'{path}:1: the first line must be {",".join(COLUMNS)}'
                      + separator_hint(','.join(head)))
    for line in lines:
        if line and not line[0].startswith('#'):
            orders.append(_order(line, starts, f'{path}:{lines.line_num}'))
    return sorted(orders, key=lambda order: order.time)


def _order(line: list[str], starts: float, where: str) -> Order:
    if len(line) != len(COLUMNS):
        raise Failure(f'{where}: has {len(line)} values, must have {",".join(COLUMNS)}')
    kind, slash, name = line[1].partition('/')
    if not (kind and slash and name):
        raise Failure(f"{where}: '{line[1]}' is not KIND/NAME, as door/kitchen0")
    try:
        time = (time_of_day(line[0]) - starts) % DAY
    except ValueError as error:
        raise Failure(f'{where}: {error}') from None
    return Order(time, kind, name, line[2], where)
