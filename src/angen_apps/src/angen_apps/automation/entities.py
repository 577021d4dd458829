"""The entities that Home Assistant makes of a world, and their states, in this process."""
import re
from dataclasses import dataclass
from typing import Any, Iterable, Iterator, Mapping

from angen_apps.mqtt.table import SIMULATION, Component, Part
from angen_apps.mqtt.things import Thing, flags_by_event, things_of
from angen_apps.mqtt.values import Value, command_of, plain, value_of
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.session import Event, World

UNKNOWN = 'unknown'
LISTED = 'angen automation-test SCENARIO --entities'
ATTRIBUTES = {'position': 'current_position'}  # Home Assistant's words for roles of parts


@dataclass
class Entity:
    """One of Home Assistant; `changed`: since when (s) its state is as it is."""

    id: str
    thing: Thing
    component: Component
    state: str = UNKNOWN
    changed: float = 0.0

    @property
    def domain(self) -> str:
        return self.id.partition('.')[0]

    def part(self, role: str = '') -> Part | None:
        """The part with a role, by our word for it or Home Assistant's."""
        return next((part for part in self.component.parts
                     if role in (part.role, ATTRIBUTES.get(part.role))), None)

    def attributes(self) -> dict[str, str]:
        """The values of its other parts."""
        found = {ATTRIBUTES.get(part.role, part.role): _text(part, self.thing)
                 for part in self.component.parts if part.role}
        if self.domain == 'light' and 'brightness' in found:
            percent = found['brightness_pct'] = found['brightness']
            if percent != UNKNOWN:
                found['brightness'] = f'{round(float(percent) * 2.55)}'
        return found

    def attribute(self, name: str) -> str:
        """One of them, or its state for an empty name; Failure if it has none of that name."""
        if not name:
            return self.state
        found = self.attributes()
        if name not in found:
            raise Failure(f"{self.id} has no attribute '{name}'; {did_you_mean(name, found)}")
        return found[name]


def slugged(text: str) -> str:
    """As Home Assistant makes an id of a name."""
    return re.sub(r'[^a-z0-9]+', '_', text.lower()).strip('_')


def ids_of(things: Iterable[Thing]) -> Iterator[tuple[str, Thing, Component]]:
    """The ids of all entities, as Home Assistant names those that it discovers."""
    taken: dict[str, int] = {}
    for thing in things:
        for component in thing.components:
            name = f'{thing.label} {component.name}' if component.name else thing.label
            found = f'{component.component}.{slugged(name)}'
            taken[found] = taken.get(found, 0) + 1
            yield (found if taken[found] == 1 else f'{found}_{taken[found]}'), thing, component


class Entities:
    """Those of a world."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.things = things_of(world, truth=False)
        del self.things[SIMULATION, SIMULATION]
        self.all = {found: Entity(found, thing, component)
                    for found, thing, component in ids_of(self.things.values())}
        self._of_thing: dict[tuple[str, str], list[Entity]] = {}
        for entity in self.all.values():
            self._of_thing.setdefault(entity.thing.key, []).append(entity)

    def find(self, name: str) -> Entity:
        """An entity by id; Failure with those that are alike."""
        if name not in self.all:
            alike = [one for one in self.all if one.partition('.')[0] == name.partition('.')[0]]
            raise Failure(f"there is no entity '{name}'; "
                          + did_you_mean(name, alike or self.all, LISTED))
        return self.all[name]

    def read(self, keys: Iterable[tuple[str, str]], now: float, flags: bool = True
             ) -> list[tuple[Entity, str, str]]:
        """Reads the states of things; returns entities of which the state or an attribute has
        changed, with the states before and now. Without `flags` those stay that events tell."""
        changes = []
        for key in keys:
            thing = self.things.get(key)
            if thing is not None:
                told = () if flags else {name for name, _ in flags_by_event(thing.kind).values()}
                changes += self._update(thing, {name: value for name, value
                                                in self._values(thing).items()
                                                if name not in told}, now)
        return changes

    def _values(self, thing: Thing) -> Mapping[str, Any]:
        try:
            return self.world.state(*thing.key).values
        except Failure:  # it has measured nothing yet
            return {}

    def on_event(self, event: Event) -> list[tuple[Entity, str, str]]:
        """The changes by an event."""
        thing = self.things.get((event.kind, event.source))
        if thing is None:
            return []
        flag = flags_by_event(event.kind).get(event.event)
        values = {**self._values(thing), **({flag[0]: flag[1]} if flag else {})}
        return self._update(thing, values, event.time)

    def _update(self, thing: Thing, values: Mapping[str, Any], now: float
                ) -> list[tuple[Entity, str, str]]:
        thing.fields.update(values)
        changes = []
        for entity in self._of_thing.get(thing.key, ()):
            shown = [thing.shown.get(part.key) for part in entity.component.parts]
            for part in entity.component.parts:
                thing.shown[part.key] = value_of(part, thing.fields, thing.shown.get(part.key))
            before, entity.state = entity.state, self._state(entity)
            if before != entity.state:
                entity.changed = now
            if shown != [thing.shown[part.key] for part in entity.component.parts]:
                changes.append((entity, before, entity.state))
        return changes

    @staticmethod
    def _state(entity: Entity) -> str:
        return _text(entity.component.parts[0], entity.thing)

    def command(self, entity: Entity, part: Part, payload: str) -> None:
        """Commands a part of an entity; Failure if the simulator rejects it."""
        try:
            texts = command_of(part, payload, entity.thing.fields)
        except ValueError as error:
            raise Failure(f'{entity.id}: {error}') from None
        for text in texts:
            try:
                self.world.command(*entity.thing.key, text)
                return
            except Failure:
                if text == texts[-1]:
                    raise


def _text(part: Part, thing: Thing) -> str:
    value: Value = thing.shown.get(part.key)
    if value is None:
        return UNKNOWN
    if isinstance(value, bool):
        return 'on' if value else 'off'
    return str(value) if part.json else plain(value, part)
