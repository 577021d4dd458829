"""Topics and payloads: a topic for each value, or those of Zigbee2MQTT."""
import json
from typing import Any, Callable, Iterable, Mapping, Protocol

from angen_apps.mqtt.naming import slug
from angen_apps.mqtt.table import Component, Part
from angen_apps.mqtt.things import Thing, noun
from angen_apps.mqtt.values import Value, flat_json, plain

Topics = dict[str, str]  # payloads by topic
Order = tuple[Thing, Part, str]  # a thing, the part that is commanded, and the payload


class Style(Protocol):
    """What differs between the two."""

    base: str
    brightness: int     # value of full brightness
    online: str         # payloads of the bridge's availability
    offline: str
    filters: list[str]  # topics of commands

    def topic(self, thing: Thing, part: Part) -> str: ...

    def command_topic(self, thing: Thing, part: Part) -> str: ...

    def template(self, part: Part) -> str:
        """What takes a part's value out of its topic, '' if nothing is needed."""

    def payloads(self, component: str, part: Part) -> dict[str, Any]:
        """The keys of discovery that say what a binary sensor's payloads are."""

    def states(self, thing: Thing, values: Mapping[str, Value]) -> Topics: ...

    def fixed(self, things: Iterable[Thing]) -> Topics:
        """What is published once of all things."""

    def things_topic(self, thing: Thing) -> str:
        """The beginning of a thing's topics."""

    def find(self, topic: str, payload: str, things: Iterable[Thing]) -> list[Order]:
        """What a message commands; ValueError with what would be right."""

    def asks(self, topic: str, things: Iterable[Thing]) -> Thing | None:
        """The thing whose state is asked for."""


class Plain:
    """PREFIX/KIND/NAME/VALUE, and /set after it."""

    brightness, online, offline = 100, 'online', 'offline'

    def __init__(self, base: str) -> None:
        self.base = base
        self.filters = [f'{base}/+/+/+/set']

    def things_topic(self, thing: Thing) -> str:
        return f'{self.base}/{slug(thing.kind)}/{slug(thing.name)}'

    def topic(self, thing: Thing, part: Part) -> str:
        return f'{self.things_topic(thing)}/{part.key}'

    def command_topic(self, thing: Thing, part: Part) -> str:
        return f'{self.topic(thing, part)}/set'

    def template(self, part: Part) -> str:
        return ''

    def payloads(self, component: str, part: Part) -> dict[str, Any]:
        return {}

    def states(self, thing: Thing, values: Mapping[str, Value]) -> Topics:
        return {self.topic(thing, part): plain(values[part.key], part) for part in thing.parts()
                if part.key in values}

    def fixed(self, things: Iterable[Thing]) -> Topics:
        return {}

    def find(self, topic: str, payload: str, things: Iterable[Thing]) -> list[Order]:
        kind, name, key = topic.removeprefix(f'{self.base}/').split('/')[:3]
        thing = next((each for each in things if (slug(each.kind), slug(each.name)) ==
                      (kind, name)), None)
        if thing is None:
            raise ValueError(f"there is no {kind:.80} '{name:.80}'")
        return [(thing, commanded(thing, key, lambda part: part.key), payload)]

    def asks(self, topic: str, things: Iterable[Thing]) -> Thing | None:
        return None


class Zigbee:
    """PREFIX/NAME with all values of a thing as JSON, and what Zigbee2MQTT has beside it."""

    brightness, online, offline = 254, '{"state": "online"}', '{"state": "offline"}'

    def __init__(self, base: str) -> None:
        self.base = base
        self.filters = [f'{base}/+/set', f'{base}/+/set/+', f'{base}/+/get']

    def things_topic(self, thing: Thing) -> str:
        name = ''.join('_' if c in '/+#' else c for c in thing.label)
        return f'{self.base}/{name}'

    def topic(self, thing: Thing, part: Part) -> str:
        return self.things_topic(thing)

    def command_topic(self, thing: Thing, part: Part) -> str:
        return f'{self.things_topic(thing)}/set/{word(part)}'

    def template(self, part: Part) -> str:
        return '{{ value_json.%s }}' % word(part)

    def payloads(self, component: str, part: Part) -> dict[str, Any]:
        if component == 'cover':
            return {f'state_{state}': leaf(state) for state in part.words.values()}
        if component != 'binary_sensor':
            return {}
        on = word(part) != 'contact'  # true is shut
        return {'payload_on': str(on), 'payload_off': str(not on)}

    def states(self, thing: Thing, values: Mapping[str, Value]) -> Topics:
        found = {word(part): self._value(thing, part, values[part.key]) for part in thing.parts()
                 if part.key in values and part.field}
        return {self.things_topic(thing): json.dumps(found, ensure_ascii=False)} if found else {}

    @staticmethod
    def _value(thing: Thing, part: Part, value: Value) -> Any:
        if isinstance(value, bool):
            if part.takes_commands:
                return 'ON' if value else 'OFF'
            return value != (word(part) == 'contact')
        if part.role == 'brightness' and isinstance(value, float):
            return round(value * 2.54)
        if isinstance(value, str) and 'OPEN' in part.commands:
            return leaf(value)
        return int(value) if isinstance(value, float) and value == int(value) else value

    def fixed(self, things: Iterable[Thing]) -> Topics:
        listed = list(things)
        devices = [described(thing) for thing in listed]
        return {f'{self.base}/bridge/devices': json.dumps(devices, ensure_ascii=False),
                **{f'{self.things_topic(thing)}/availability': self.online for thing in listed}}

    def find(self, topic: str, payload: str, things: Iterable[Thing]) -> list[Order]:
        name, _, key = topic.removeprefix(f'{self.base}/').partition('/set')
        thing = self._named(name, things)
        if thing is None:
            raise ValueError(f"there is no '{name:.80}'")
        given = {key.strip('/'): payload} if key else (
            flat_json(payload) if payload.lstrip().startswith('{') else {'state': payload})
        orders = []
        for property_, text in given.items():
            part = commanded(thing, property_, word)
            if part.role == 'brightness':
                text = _percent(text)
            orders.append((thing, part, text))
        if any(part.role for _, part, _ in orders):  # {"state": "ON", "brightness": 9} is one
            orders = [order for order in orders if order[1].role or order[2].upper() != 'ON']
        return orders

    def asks(self, topic: str, things: Iterable[Thing]) -> Thing | None:
        name, get, _ = topic.removeprefix(f'{self.base}/').rpartition('/get')
        return self._named(name, things) if get else None

    def _named(self, name: str, things: Iterable[Thing]) -> Thing | None:
        return next((each for each in things
                     if self.things_topic(each) == f'{self.base}/{name}'), None)


STYLES: dict[str, Callable[[str], Style]] = {'plain': Plain, 'zigbee2mqtt': Zigbee}


def leaf(state: str) -> str:
    """The state of a cover in Zigbee2MQTT."""
    return 'CLOSE' if state == 'closed' else state.upper()


def _percent(text: str) -> str:
    try:
        return str(float(text) / 2.54)
    except ValueError:
        return text


def word(part: Part) -> str:
    """The property of Zigbee2MQTT."""
    return part.zigbee or part.key


def commanded(thing: Thing, key: str, called: Any) -> Part:
    """The part that takes commands under that word."""
    found = {called(part): part for part in thing.parts() if part.takes_commands}
    if key not in found:
        raise ValueError(f"'{key:.80}' takes no commands; "
                         + (f'these do: {", ".join(found)}' if found else 'nothing of it does'))
    return found[key]


def described(thing: Thing) -> dict[str, Any]:
    """A thing in bridge/devices."""
    exposes = [_exposed(component) for component in thing.components]
    return {'ieee_address': f'angen_{slug(thing.kind)}_{slug(thing.name)}',
            'friendly_name': thing.label, 'type': 'EndDevice', 'supported': True,
            'disabled': False, 'interview_completed': True,
            'definition': {'model': thing.kind, 'vendor': 'Angen', 'description': noun(thing),
                           'exposes': exposes}}


def _exposed(component: Component) -> dict[str, Any]:
    features = [_feature(part) for part in component.parts]
    if component.component in ('light', 'cover', 'fan', 'switch', 'climate'):
        return {'type': component.component, 'features': features}
    return features[0]


def _feature(part: Part) -> dict[str, Any]:
    access = (1 if part.field else 0) + (2 if part.takes_commands else 0)
    feature: dict[str, Any] = {'name': word(part), 'property': word(part), 'access': access}
    if part.type == 'flag':
        on, off = ('ON', 'OFF') if part.takes_commands else (True, False)
        return {'type': 'binary', **feature, 'value_on': on, 'value_off': off}
    if part.commands or part.words:
        return {'type': 'enum', **feature, 'values': list(part.commands or part.words.values())}
    if not part.is_number:
        return {'type': 'text', **feature}
    scale = 2.54 if part.role == 'brightness' else 1.0
    limits = {} if part.low == -part.high else {'value_min': part.low * scale,
                                                'value_max': part.high * scale}
    return {'type': 'numeric', **feature, **limits}
