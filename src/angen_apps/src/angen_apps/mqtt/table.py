"""The components of Home Assistant that a kind has: by components.yaml, else by a rule."""
import dataclasses
import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Mapping, Sequence

import yaml

from angen_apps.controls.offers import offers, pair
from angen_tools.common.catalog import Plugin

FILE = Path(__file__).with_name('components.yaml')
SCALARS = ('flag', 'integer', 'number')  # types of fields that a summary has
NUMBERS = ('integer', 'number', 'numbers')
CONFIG = ('device_class', 'state_class')
SIMULATION = 'simulation'  # the kind of the one thing that is no device or sensor


@dataclass(frozen=True)
class Part:
    """A value of a component, with a topic of its own, which ends with `key`; `role` is its part of
    the component, '' its state. Without a field it has commands only."""

    key: str
    role: str = ''
    field: str = ''
    type: str = ''  # the type of its field
    commands: Mapping[str, str] = dataclasses.field(default_factory=dict)
    verb: str = ''
    low: float = -math.inf
    high: float = math.inf
    words: Mapping[str, str] = dataclasses.field(default_factory=dict)
    invert: bool = False
    scale: float = 1.0
    decimals: int = 0
    share: str = ''
    over: float = 0.0
    json: bool = False
    each: str = ''
    index: int | None = None
    event: str = ''
    constant: str = ''
    zigbee: str = ''

    @property
    def takes_commands(self) -> bool:
        return bool(self.commands or self.verb)

    @property
    def is_number(self) -> bool:
        return self.type in NUMBERS and not self.words and not self.constant


@dataclass(frozen=True)
class Component:
    """A component of Home Assistant; `name` is None for the one that is called as its device."""

    component: str
    key: str
    name: str | None
    config: Mapping[str, Any]
    parts: tuple[Part, ...]


@cache
def table() -> dict[str, Any]:
    """The contents of components.yaml."""
    read: dict[str, Any] = yaml.safe_load(FILE.read_text(encoding='utf-8'))
    return read


def words_of(kind: str) -> dict[str, Any]:
    """The noun of a kind, and the words that it replaces."""
    entry = table()['kinds'].get(kind, {})
    return {'noun': entry.get('noun', kind.replace('_', ' ')), 'drop': entry.get('drop', [])}


def is_shown(kind: Plugin, truth: bool) -> bool:
    """Whether things of a kind are in a smart home: what only the truth knows by wish."""
    return kind['kind'] not in table()['hidden'] and (
        truth or not table()['kinds'].get(kind['kind'], {}).get('truth', False))


def components(kind: Plugin, name: str, floors: Sequence[int] = (),
               state: Mapping[str, Any] | None = None) -> list[Component]:
    """The components of a thing. `state` and the floors are needed of some kinds only."""
    known = table()['kinds'].get(kind['kind'])
    entries = guessed(kind) if known is None else known['entities']
    found = {key: entry for key, entry in entries.items() if _has(entry, name, state or {})}
    main = next((key for key, entry in found.items() if 'name' not in entry), '')
    return [_component(kind, key, entry, key == main, floors) for key, entry in found.items()]


def needs_state(kind: Plugin) -> bool:
    """Whether the components of a kind depend on its state."""
    entries = table()['kinds'].get(kind['kind'], {}).get('entities', {}).values()
    return any('needs' in entry or 'floors' in entry for entry in entries)


def _has(entry: Mapping[str, Any], name: str, state: Mapping[str, Any]) -> bool:
    if 'needs' in entry and not math.isfinite(state.get(entry['needs'], math.nan)):
        return False
    return entry.get('only', '') in name and ('not' not in entry or entry['not'] not in name)


def _component(kind: Plugin, key: str, entry: Mapping[str, Any], is_main: bool,
               floors: Sequence[int]) -> Component:
    parts = [_part(kind, key, '', entry, floors)]
    parts += [_part(kind, f'{key}_{role}' if kind['kind'] == 'climate' else role, role, each, ())
              for role, each in (entry.get('parts') or {}).items()]
    config = {**_defaults(kind, entry), **{k: entry[k] for k in CONFIG if k in entry},
              **entry.get('options', {})}
    if 'unit' in entry:
        config['unit_of_measurement'] = entry['unit']
    main = parts[0]
    if entry['component'] == 'number':
        config |= {'min': main.low, 'max': main.high, 'step': 10.0 ** -main.decimals}
    if entry['component'] == 'select':
        config['options'] = list(main.commands)
    if entry['component'] == 'sensor' and main.type == 'choice':
        config |= {'device_class': 'enum', 'options': list(main.words.values())}
    if main.event:
        config['event_types'] = [main.event]
    name = None if is_main else str(entry.get('name', key.replace('_', ' '))).capitalize()
    return Component(entry['component'], key, name,
                     {k: v for k, v in config.items() if v is not None}, tuple(parts))


def _field(kind: Plugin, name: str) -> Mapping[str, Any]:
    return next((each for each in kind['fields'] if each['name'] == name), {})


def _defaults(kind: Plugin, entry: Mapping[str, Any]) -> dict[str, Any]:
    """Unit and class of a sensor or number of a known unit."""
    found = _field(kind, entry.get('field', ''))
    if entry['component'] not in ('sensor', 'number') or found.get('type') not in NUMBERS:
        return {}
    unit = found['unit']
    known = table()['units'].get(unit, {})
    config: dict[str, Any] = {'device_class': known.get('device_class')}
    if unit and unit != '1':
        config['unit_of_measurement'] = unit
    if entry['component'] == 'sensor' and known:
        config['state_class'] = 'measurement'
    return config


def _part(kind: Plugin, key: str, role: str, entry: Mapping[str, Any], floors: Sequence[int]
          ) -> Part:
    found = _field(kind, entry.get('field', ''))
    verb: dict[str, Any] = next((v for v in kind['verbs'] if v['name'] == entry.get('verb')), {})
    commands, words = dict(entry.get('commands', {})), dict(entry.get('words', {}))
    if entry.get('floors'):
        commands = {o.label: o.text for o in offers(kind, floors)}
        words = {str(floor): label for floor, label in zip(floors, commands)}
    elif found.get('type') == 'choice' and not words:
        words = {word: word.lower() for word in found['words']}
    low, high = entry.get('low', verb.get('min')), entry.get('high', verb.get('max'))
    if 'share' in entry:
        low, high = 0.0, 100.0
    return Part(
        key, role, entry.get('field', ''), entry.get('type', found.get('type', '')), commands,
        entry.get('verb', ''), -math.inf if low is None else float(low),
        math.inf if high is None else float(high), words,
        decimals=entry.get('decimals', table()['units'].get(found.get('unit'), {}).get(
            'decimals', 0)),
        **{name: entry[name] for name in ('invert', 'scale', 'share', 'over', 'json', 'each',
                                          'index', 'event', 'constant', 'zigbee')
           if name in entry})


def guessed(kind: Plugin) -> dict[str, Any]:
    """The rule for a kind of a plug-in that the table does not know."""
    if kind.get('on_demand'):
        return {}
    found: dict[str, Any] = {}
    opposite = pair(kind) or ()
    if opposite == ('On', 'Off') and _field(kind, 'on').get('type') == 'flag':
        found['state'] = {'component': 'switch', 'field': 'on',
                          'commands': {'ON': 'On', 'OFF': 'Off'}}
    elif opposite == ('Open', 'Close') and _field(kind, 'mode').get('type') == 'choice':
        known = table()['kinds']['door']['entities']['state']['words']
        found['state'] = {'component': 'cover', 'field': 'mode', 'words': known,
                          'commands': {'OPEN': 'Open', 'CLOSE': 'Close'}}
    used = {entry['field'] for entry in found.values()}
    done = set(opposite) if found else set()
    for verb in kind['verbs']:
        entry = {} if verb['name'] in done else _of_verb(kind, verb)
        if entry:
            found[_key(verb['name'])] = entry
            used.add(entry.get('field', ''))
    for each in kind['fields']:
        if each['name'] not in used and (each['shown'] or each['alarm']):
            found.setdefault(each['name'], _of_field(each))
    return {key: entry for key, entry in found.items() if entry}


def _of_verb(kind: Plugin, verb: Mapping[str, Any]) -> dict[str, Any]:
    if not verb['argument']:
        return {'component': 'button', 'commands': {'PRESS': verb['name']}}
    if verb['count'] != 1 or verb['min'] is None or verb['max'] is None:
        return {}
    alike = [each['name'] for each in kind['fields']
             if each['type'] in SCALARS[1:] and each['unit'] == verb['unit']]
    state = {'field': alike[0]} if len(alike) == 1 else {}
    return {'component': 'number', 'verb': verb['name'], **state}


def _of_field(each: Mapping[str, Any]) -> dict[str, Any]:
    if each['type'] == 'flag':
        return {'component': 'binary_sensor', 'field': each['name']}
    if each['type'] in ('integer', 'number', 'choice', 'text'):
        entry = {'component': 'sensor', 'field': each['name']}
        return {**entry, 'decimals': each['decimals']} if each['decimals'] else entry
    return {}


def _key(verb: str) -> str:
    """FrontLeft as front_left."""
    return ''.join(f'_{c.lower()}' if c.isupper() else c for c in verb).lstrip('_')
