"""angen set: commands to devices, checked before they are sent."""
import time
from typing import Any, Sequence

from angen_tools.common.catalog import Plugin, kind_of
from angen_tools.common.failure import Failure
from angen_tools.common.shown import BETWEEN, values_of
from angen_tools.common.verbs import Order, parse
from angen_tools.live.summary import Board
from angen_tools.session import Entity
from angen_tools.session.live import Live

STATE_LIMIT = 0.6  # s of wall time within which a state follows its command
NEXT_LIMIT = 0.5  # s of wall time after which a busy device executes the command later


def set_device(kind_name: str, name: str, words: Sequence[str]) -> dict[str, Any]:
    """Sends the command; returns the result, whose `text` has the device's state in words, and
    for which event the command waits.

    ValueError where the words are not a command of the kind; Failure if no device has that name
    or the simulator rejects it.
    """
    kind = kind_of(kind_name)
    order = parse(kind, words)
    world = Live()
    devices = [entity for entity in world.entities(kind_name) if name in ('all', entity.name)]
    if name == 'all' and not devices:
        raise Failure(f'the world has no {kind_name}')
    board = Board(world)
    before = world.fence()
    state = world.command(kind_name, name, order.text)
    values: dict[str, Any] = {}
    if name == 'all':
        text = f'all of kind {kind_name}, {len(devices)}: {order.text}'
    else:
        state = changed(board, (kind_name, name), state)
        values = values_of(kind, state)
        state = state.replace(BETWEEN, ', ')
        text = f'{kind_name} {name}: {state}'
    done = {'kind': kind_name, 'names': [device.name for device in devices],
            'command': order.text, 'waits': ''}
    if world.fence() == before and world.stats.paused:
        done['waits'] = 'the simulation is no longer paused'
        text += f'; {order.text} is executed when {done["waits"]}'
    elif any(comes_later(world, kind, order, device) for device in devices):
        done['waits'] = 'the device has finished its current command'
        text += f'; {order.text} is executed next'
    elif has_target(kind, order):
        text += f'; its target is {order.verb["argument"]} {order.number:g}'
    return {**done, 'state': state, 'values': values, 'text': text}


def changed(board: Board, which: tuple[str, str], state: str) -> str:
    """The state of a device after its next change; the same state where it does not change."""
    row = board.rows.get(which)
    end = time.monotonic() + STATE_LIMIT
    while row is not None and state == row.text and (left := end - time.monotonic()) > 0:
        board.receive(left)
        state = board.rows[which].text if which in board.rows else state
    return state


def target_of(order: Order) -> str:
    return f'target_{order.verb.get("argument", "")}'


def has_target(kind: Plugin, order: Order) -> bool:
    """Whether the state of the kind has the target that the number of an order sets."""
    return any(field['name'] == target_of(order) for field in kind['fields'])


def comes_later(world: Live, kind: Plugin, order: Order, device: Entity) -> bool:
    """Whether a device does something else first, as an elevator on its way does.

    For a verb with the argument X and a state with the field target_X, the current target.
    """
    target = target_of(order)
    if not has_target(kind, order) or not device.topic:
        return False
    return not world.until(lambda: world.state(device.kind, device.name).values.get(
        target, order.number) == order.number, NEXT_LIMIT)
