"""Checks discovery messages against home_assistant.yaml."""
from functools import cache
from pathlib import Path
from typing import Any, Callable, Mapping

import yaml

TYPES: dict[str, Callable[[Any], bool]] = {
    'text': lambda v: isinstance(v, str), 'text or null': lambda v: isinstance(v, str | None),
    'flag': lambda v: isinstance(v, bool), 'map': lambda v: isinstance(v, dict),
    'number': lambda v: isinstance(v, int | float) and not isinstance(v, bool),
    'list': lambda v: isinstance(v, list) and bool(v), 'class': lambda v: isinstance(v, str),
    'template': lambda v: isinstance(v, str) and v.startswith('{{') and v.endswith('}}'),
    'topic': lambda v: isinstance(v, str) and bool(v) and not set(v) & set('+#\0')}


@cache
def schema() -> dict[str, Any]:
    read: dict[str, Any] = yaml.safe_load(
        Path(__file__).with_name('home_assistant.yaml').read_text())
    return read


def errors(topic: str, message: Mapping[str, Any]) -> list[str]:
    """What Home Assistant would not accept in the message of an entity or device."""
    _, component, *_, last = topic.split('/')
    if last != 'config':
        return [f'{topic}: is not a topic of discovery']
    if component != 'device':
        return [f'{topic}: {each}' for each in of_entity(component, message)]
    shared = {key: value for key, value in message.items() if key != 'components'}
    return [f'{topic}: {key}: {each}' for key, entity in message['components'].items()
            for each in of_entity(entity['platform'], {**shared, **{
                name: value for name, value in entity.items() if name != 'platform'}})]


def of_entity(component: str, message: Mapping[str, Any]) -> list[str]:
    if component not in schema()['components']:
        return [f'there is no component {component}']
    found = of_keys({**schema()['shared'], **schema()['components'][component]}, message)
    found += of_keys(schema()['device'], message.get('device', {}))
    found += of_keys(schema()['origin'], message.get('origin', {}))
    for each in message.get('availability', []):
        found += of_keys(schema()['availability'], each)
    return found + of_class(component, message)


def of_keys(known: Mapping[str, str], message: Mapping[str, Any]) -> list[str]:
    types = {key.removesuffix('!'): kind for key, kind in known.items()}
    found = [f'{key} is not known' for key in message if key not in types]
    found += [f'{key}: {message[key]!r} is not a {kind}' for key, kind in types.items()
              if key in message and not TYPES[kind](message[key])]
    return found + [f'{key[:-1]} is missing' for key in known
                    if key.endswith('!') and key[:-1] not in message]


def of_class(component: str, message: Mapping[str, Any]) -> list[str]:
    given, unit = message.get('device_class'), message.get('unit_of_measurement')
    if component not in ('sensor', 'number'):
        allowed = schema()['classes'].get(component, [])
        return [] if given is None or given in allowed else [f'no {component} is a {given}']
    if given == 'enum':
        return [] if message.get('options') and unit is None and 'state_class' not in message \
            else ['an enum has options, and neither unit nor state_class']
    if given is not None and unit not in schema()['units'].get(given, []):
        return [f'{given} is not measured in {unit}']
    if message.get('state_class') not in (None, 'measurement', 'total', 'total_increasing'):
        return [f'{message["state_class"]} is not a state_class']
    return []
