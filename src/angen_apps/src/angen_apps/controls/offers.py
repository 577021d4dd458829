"""The entries of a menu and the command of a click, by the verbs of a kind."""
from dataclasses import dataclass
from typing import Any, Sequence

from angen_tools.common.catalog import Plugin, is_robot

PAIRS = (('On', 'Off'), ('Open', 'Close'))
PARTS = 5  # choices of a number with limits
SEND = 'Send to'


@dataclass(frozen=True)
class Offer:
    """A line of a menu, and the command that it sends; under SEND it is a room, to which one is
    sent. `under` is the line that has it in its submenu."""

    label: str
    text: str = ''
    under: str = ''


def offers(kind: Plugin, floors: Sequence[int] = (), rooms: Sequence[str] = ()) -> list[Offer]:
    """Verbs without a number, floors, some numbers of verbs with limits, and the rooms to which a
    person or a robot may be sent."""
    found: list[Offer] = []
    for verb in kind['verbs']:
        name = verb['name']
        if not verb['argument']:
            found.append(Offer(name, name))
        elif verb['argument'] == 'floor':
            found += [Offer(f'Floor {floor}', f'{name}{floor}') for floor in floors]
        elif verb['count'] == 1 and verb['unit'] == '%' and verb['max'] is not None:
            found += [Offer(f'{name} {value:g} {verb["unit"]}', f'{name} {value:g}', under=name)
                      for value in parts(verb['min'] or 0.0, verb['max'])]
    if is_robot(kind) or walk(kind):
        found += [Offer(room, under=SEND) for room in rooms]
    return found


def walk(kind: Plugin) -> str:
    """The verb that takes a place, '' where there is none."""
    return next((v['name'] for v in kind['verbs'] if v['count'] == 2 and v['unit'] == 'm'), '')


def parts(low: float, high: float) -> list[float]:
    """Evenly spaced, both ends included."""
    return [low + (high - low) * i / (PARTS - 1) for i in range(PARTS)]


def pair(kind: Plugin) -> tuple[str, str] | None:
    """Two opposite verbs, between which a click changes."""
    names = [verb['name'] for verb in kind['verbs'] if not verb['argument']]
    return next(((on, off) for on, off in PAIRS if on in names and off in names), None)


def toggled(verbs: tuple[str, str], state: Any) -> str:
    """The verb of the pair that changes a state."""
    on, off = verbs
    if state is None:
        return on
    if 'on' in getattr(state, 'names', ()):  # an angen_msgs/Reading
        return off if state.values[list(state.names).index('on')] else on
    if hasattr(state, 'on'):
        return off if state.on else on
    target = getattr(state, 'target', None)  # a door's, rad: 0 is shut
    return off if target is not None and abs(target) > 0.1 else on
