"""A plan as a card of Home Assistant: a picture-elements card with the entities of angen mqtt."""
import math
from pathlib import Path
from typing import Iterator, NamedTuple

from angen_apps.automation.entities import ids_of
from angen_apps.mqtt.table import SIMULATION, Component
from angen_apps.mqtt.things import things_of
from angen_apps.plan.draw import Axes
from angen_tools.common.files import write_text
from angen_tools.common.home import Home
from angen_tools.session.in_process import InProcess

ICONS = ('light', 'switch', 'fan', 'cover', 'binary_sensor', 'climate', 'vacuum')
TOGGLED = ('light', 'switch', 'fan', 'cover')
APART = 2.4   # % of the picture's width between two elements
RINGS = 4     # rounds of places about one that is taken


class Element(NamedTuple):
    """An entity in the picture, as an icon or a number; left and top in %."""

    entity: str
    is_number: bool
    left: float
    top: float


def write(path: Path, world: Path, axes: Axes, image: str) -> None:
    """Writes the card of a world that is drawn on axes."""
    opened = InProcess.load(str(world))
    opened.world.step()  # all devices have a state
    found = list(_elements(opened, axes))
    lines = ['type: picture-elements', f'image: /local/{image}', 'elements:']
    for each in found:
        domain = each.entity.partition('.')[0]
        kind = 'state-label' if each.is_number else 'state-icon'
        lines += [f'  - type: {kind}', f'    entity: {each.entity}']
        if domain in TOGGLED:
            lines.append('    tap_action: {action: toggle}')
        lines.append(f'    style: {{left: {each.left:.2f}%, top: {each.top:.2f}%}}')
    write_text(path, '\n'.join(lines) + '\n')


def _elements(world: InProcess, axes: Axes) -> Iterator[Element]:
    poses = {(entity.kind, entity.name): entity.pose for entity in world.entities()}
    things = {key: thing for key, thing in things_of(world, truth=False).items()
              if key != (SIMULATION, SIMULATION)}
    taken: list[tuple[float, float]] = []
    seen: set[tuple[str, str]] = set()
    for name, thing, component in ids_of(things.values()):
        if thing.key in seen or not _is_shown(component):
            continue
        x, y, z = poses[thing.key][:3]
        number = storey_of(world.home, (x, y, z))
        axis = next((axis for axis, storey in axes if storey.number == number), axes[0][0])
        axis.apply_aspect()
        across, up = axis.figure.transFigure.inverted().transform(
            axis.transData.transform((x, y)))
        wide, high = axis.figure.get_size_inches()
        left, top = _free(100.0 * across, 100.0 * (1.0 - up), taken, wide / high)
        taken.append((left, top))
        seen.add(thing.key)
        yield Element(name, 'unit_of_measurement' in component.config, left, top)


def storey_of(home: Home, at: tuple[float, float, float]) -> int:
    """The number of the storey of a thing, which may be at the ceiling."""
    room = home.room_at(*at)
    return home.storey_at(at[2]) if room is None else room.storey


def _is_shown(component: Component) -> bool:
    """Whether an entity says what its thing does: the one that has no name of its own; not
    the leaves of furniture."""
    if component.component == 'cover' and not component.config.get('device_class'):
        return False
    return component.name is None and component.component in (*ICONS, 'sensor')


def _free(left: float, top: float, taken: list[tuple[float, float]], shape: float
          ) -> tuple[float, float]:
    """The nearest place without another element; `shape`: width over height of the picture."""
    for ring in range(RINGS):
        for turn in range(max(1, 6 * ring)):
            angle = math.tau * turn / max(1, 6 * ring)
            x = left + APART * ring * math.cos(angle)
            y = top + APART * shape * ring * math.sin(angle)
            if all(math.hypot(x - a, (y - b) / shape) >= 0.95 * APART for a, b in taken):
                return x, y
    return left, top
