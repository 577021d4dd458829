"""The things of a world: each is a device of Home Assistant."""
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, Iterator

from angen_apps.controls.offers import walk
from angen_apps.mqtt.naming import area, distinct, label
from angen_apps.mqtt.table import (SCALARS, SIMULATION, Component, Part, components, is_shown,
                                   needs_state, table)
from angen_apps.mqtt.values import Value
from angen_tools.common.catalog import Plugin, is_robot, kinds
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.session import Entity, World

OUTSIDE = 'outside'
CONTROLS: Plugin = {'kind': SIMULATION, 'verbs': [], 'fields': [
    {'name': 'time', 'type': 'number', 'unit': 's'}, {'name': 'rate', 'type': 'number', 'unit': ''},
    {'name': 'factor', 'type': 'number', 'unit': ''}, {'name': 'paused', 'type': 'flag',
                                                       'unit': ''}]}


@dataclass
class Thing:
    """A device or sensor of a world, and the fields of its state that are known."""

    kind: str
    name: str
    model: str
    label: str
    area: str
    components: list[Component]
    fields: dict[str, Any] = field(default_factory=dict)
    shown: dict[str, Value] = field(default_factory=dict)  # by the keys of its parts
    time: float = 0.0  # s, of the last event that changed a field

    @property
    def key(self) -> tuple[str, str]:
        return self.kind, self.name

    def parts(self) -> Iterator[Part]:
        for component in self.components:
            yield from component.parts

    @property
    def moves(self) -> bool:
        """Whether it has a room that changes."""
        return any(part.type == 'room' for part in self.parts())


def things_of(world: World, truth: bool) -> dict[tuple[str, str], Thing]:
    """The present things, by kind and name."""
    home = world.home
    found = [(entity, kinds()[entity.kind]) for entity in world.entities()
             if entity.kind in kinds() and is_shown(kinds()[entity.kind], truth)]
    made = [_thing(world, home, entity, kind) for entity, kind in found]
    rooms = sorted({area(room.name, home) for room in home.rooms}) + [OUTSIDE]
    for thing in made:
        thing.components = [_with_rooms(each, rooms) for each in thing.components]
    simulation = Thing(SIMULATION, SIMULATION, '', 'Simulation', '',
                       components(CONTROLS, SIMULATION))
    shown = [simulation, *(thing for thing in made if thing.components)]
    names = distinct([(thing.label, f'{thing.kind} {thing.name}') for thing in shown])
    for thing, name in zip(shown, names):
        thing.label = name
    return {thing.key: thing for thing in shown}


def _with_rooms(component: Component, rooms: list[str]) -> Component:
    """A component with the choice of rooms that it shows."""
    if component.config.get('device_class') != 'enum' or component.parts[0].type != 'room':
        return component
    return replace(component, config={**component.config, 'options': rooms})


def _thing(world: World, home: Home, entity: Entity, kind: Plugin) -> Thing:
    state: dict[str, Any] = {}
    if needs_state(kind):
        try:
            state = dict(world.state(entity.kind, entity.name).values)
        except Failure:  # it has none yet
            pass
    return Thing(entity.kind, entity.name, entity.model, label(entity.kind, entity.name, home),
                 area(entity.room, home) if entity.room else '',
                 components(kind, entity.name, range(state.get('floors', 0)), state), state)


def followed(things: dict[tuple[str, str], Thing]) -> list[str]:
    """The kinds whose states come one by one: devices that stay where they are, and sensors with
    lists, which no summary has."""
    found = set()
    for thing in things.values():
        kind = kinds().get(thing.kind)
        if kind is None or is_robot(kind) or walk(kind):
            continue
        types = {part.type for part in thing.parts() if part.field}
        if kind['role'] == 'device' or types - set(SCALARS):
            found.add(thing.kind)
    return sorted(found)


@cache
def flags_by_event(kind: str) -> dict[str, tuple[str, bool]]:
    """The field and its value after an event of a sensor, by the event's name."""
    return {event: (each['name'], value) for each in kinds().get(kind, {'fields': []})['fields']
            for event, value in zip(each.get('events', ()), (True, False))}


def noun(thing: Thing) -> str:
    """What a thing is, for people."""
    known = table()['kinds'].get(thing.kind, {}).get('noun') or thing.kind.replace('_', ' ')
    return str(known).capitalize()
