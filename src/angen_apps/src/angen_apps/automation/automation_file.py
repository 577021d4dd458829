"""Reads automations as Home Assistant writes them; what the bench does not run is a Failure with
file and line."""
import math
import re
from pathlib import Path
from typing import Any, Callable, Iterable

from angen_apps.automation.automations import (
    MODES, Action, Automation, Choice, Condition, Delay, Logic, NumericCondition, NumericTrigger,
    Service, StateCondition, StateTrigger, Stop, SunCondition, SunTrigger, Test, TimeCondition,
    TimeTrigger, Trigger, TriggerCondition, Wait, Where)
from angen_apps.automation.entities import Entities
from angen_apps.automation.services import NOTES, SERVICES, data_of, is_known, order_of
from angen_tools.common.clock import DAY
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.yaml_file import Entries, YamlFile, is_list, is_text, line_of

WEEKDAYS = ('mon', 'tue', 'wed', 'thu', 'fri', 'sat', 'sun')
SUN = ('sunrise', 'sunset')
CLOCK = re.compile(r'(-?)(\d+):(\d\d)(?::(\d\d(?:\.\d+)?))?')
TRIGGERS = ('state', 'numeric_state', 'time', 'sun')
CONDITIONS = ('state', 'numeric_state', 'time', 'sun', 'trigger', 'and', 'or', 'not')
ACTIONS = ('service', 'action', 'delay', 'wait_for_trigger', 'condition', 'if', 'choose', 'stop',
           'and', 'or', 'not')
NOTED = ('alias', 'enabled')  # keys that change nothing, as long as nothing is disabled
TOP = ('id', 'alias', 'description', 'mode', 'trigger', 'triggers', 'condition', 'conditions',
       'action', 'actions', 'max_exceeded')


def read_automations(path: Path, entities: Entities) -> list[Automation]:
    """The automations of a file, whose entities exist."""
    return _Reader(path, entities).automations()


class _Reader(YamlFile):

    def __init__(self, path: Path, entities: Entities) -> None:
        super().__init__(path)
        self._entities = entities

    def automations(self) -> list[Automation]:
        return [self._automation(node, number)
                for number, node in enumerate(self.nodes(self.root, 'the file'), 1)]

    def _automation(self, node: Any, number: int) -> Automation:
        top = self.entries(node, 'an automation', TOP)
        found = {}
        for one in ('trigger', 'condition', 'action'):
            both = [key for key in (one, f'{one}s') if key in top]
            if len(both) == 2:
                raise self.fail(node, f'an automation has {one} or {one}s, not both')
            found[one] = top[both[0]] if both else None
        for one in ('trigger', 'action'):
            if found[one] is None:
                raise self.fail(node, f'the automation has no {one}')
        name = next((self.text(top[key], key) for key in ('alias', 'id') if key in top),
                    f'automation {number}')
        mode = top.of('mode', self.choice, MODES[0], MODES)
        return Automation(name, self._each(found['trigger'], self._trigger),
                          self._each(found['condition'], self._condition),
                          self._each(found['action'], self._action), mode,
                          Where(self.path, line_of(node)))

    def _each(self, node: Any, read: Callable[[Any], Any]) -> tuple[Any, ...]:
        if node is None or (is_list(node) and not node.value):
            return ()
        return tuple(read(each) for each in (node.value if is_list(node) else [node]))

    def _parts(self, node: Any, what: str, keys: Iterable[str], required: Iterable[str] = ()
               ) -> Entries:
        parts = self.entries(node, what, (*keys, *NOTED), required)
        if 'enabled' in parts and self.text(parts['enabled'], 'enabled').lower() != 'true':
            raise self.fail(parts['enabled'], f'leave {what} out instead of disabling it')
        return parts

    def _kind(self, node: Any, what: str, words: Iterable[str], keys: Iterable[str]) -> str:
        """The value of the key that says what a mapping is."""
        entries = self.entries(node, what)
        for key in words:
            if key in entries:
                return self.choice(entries[key], key, keys)
        raise self.fail(node, f'{what} has no {next(iter(words))}')

    # --- values

    def _seconds(self, node: Any, what: str) -> float:
        """00:05:00, a number of seconds, or {minutes: 5}."""
        if not is_text(node):
            units = {'days': DAY, 'hours': 3600.0, 'minutes': 60.0, 'seconds': 1.0,
                     'milliseconds': 0.001}
            entries = self.entries(node, what, units)
            return sum(self.number(each, key, 0.0, 1e9) * units[key]
                       for key, each in entries.items())
        text = self.text(node, what)
        if CLOCK.fullmatch(text):
            return self._clock(node, what)
        return self.number(node, what, 0.0, 1e9)

    def _clock(self, node: Any, what: str) -> float:
        found = CLOCK.fullmatch(self.text(node, what))
        if not found:
            raise self.fail(node, f"{what} is '{node.value}', must be a time as 07:30:00")
        hours, minutes, seconds = int(found[2]), int(found[3]), float(found[4] or 0.0)
        return (-1 if found[1] else 1) * (hours * 3600.0 + minutes * 60.0 + seconds)

    def _time(self, node: Any, what: str) -> float:
        found = self._clock(node, what)
        if not 0.0 <= found < DAY:
            raise self.fail(node, f'{what} must be a time of day, from 00:00:00 to 23:59:59')
        return found

    def _ids(self, node: Any) -> tuple[str, ...]:
        """Ids of entities that exist."""
        found: list[str] = []
        for each in self.nodes(node, 'entity_id'):
            for name in self.text(each, 'entity_id').split(','):
                try:
                    found.append(self._entities.find(name.strip()).id)
                except Failure as error:
                    raise self.fail(each, str(error)) from None
        return tuple(found)

    def _states(self, node: Any, entities: tuple[str, ...], attribute: str = '') -> tuple[str, ...]:
        """States that the entities can have."""
        states = self.texts(node, 'state')
        domains = {name.partition('.')[0] for name in entities}
        for state in states:
            if '{' in state:
                raise self.fail(node, 'templates are not run by the bench')
            if not attribute and domains <= {'binary_sensor', 'light', 'switch', 'fan'} \
                    and state not in ('on', 'off', 'unknown', 'unavailable'):
                raise self.fail(node, f"{entities[0]} is never '{state}'; it is on or off")
        return states

    def _limits(self, parts: Entries, node: Any) -> tuple[float, float]:
        above = parts.of('above', self.number, -math.inf)
        below = parts.of('below', self.number, math.inf)
        if 'above' not in parts and 'below' not in parts:
            raise self.fail(node, 'numeric_state needs above or below')
        if above >= below:
            raise self.fail(node, f'no number is above {above:g} and below {below:g}')
        return above, below

    def _attribute(self, parts: Entries, entities: tuple[str, ...]) -> str:
        if 'attribute' not in parts:
            return ''
        name = self.text(parts['attribute'], 'attribute')
        for entity in entities:
            try:
                self._entities.find(entity).attribute(name)
            except Failure as error:
                raise self.fail(parts['attribute'], str(error)) from None
        return name

    # --- triggers

    def _trigger(self, node: Any) -> Trigger:
        kind = self._kind(node, 'a trigger', ('platform', 'trigger'), TRIGGERS)
        word = 'platform' if 'platform' in self.entries(node, 'a trigger') else 'trigger'
        read = {'state': self._state_trigger, 'numeric_state': self._numeric_trigger,
                'time': self._time_trigger, 'sun': self._sun_trigger}[kind]
        return read(node, word)

    def _state_trigger(self, node: Any, word: str) -> Trigger:
        parts = self._parts(node, 'a state trigger', (word, 'entity_id', 'from', 'to', 'for', 'id'),
                            ('entity_id',))
        entities = self._ids(parts['entity_id'])
        to, origin = (self._states(parts[key], entities) if key in parts else ()
                      for key in ('to', 'from'))
        return StateTrigger(entities, to, origin, parts.of('for', self._seconds, 0.0),
                            parts.of('id', self.text, ''))

    def _numeric_trigger(self, node: Any, word: str) -> Trigger:
        parts = self._parts(node, 'a numeric_state trigger', (
            word, 'entity_id', 'above', 'below', 'attribute', 'for', 'id'), ('entity_id',))
        entities = self._ids(parts['entity_id'])
        return NumericTrigger(entities, *self._limits(parts, node),
                              self._attribute(parts, entities),
                              parts.of('for', self._seconds, 0.0), parts.of('id', self.text, ''))

    def _time_trigger(self, node: Any, word: str) -> Trigger:
        parts = self._parts(node, 'a time trigger', (word, 'at', 'id'), ('at',))
        return TimeTrigger(self._time(parts['at'], 'at'), parts.of('id', self.text, ''))

    def _sun_trigger(self, node: Any, word: str) -> Trigger:
        parts = self._parts(node, 'a sun trigger', (word, 'event', 'offset', 'id'), ('event',))
        return SunTrigger(self.choice(parts['event'], 'event', SUN),
                          parts.of('offset', self._offset, 0.0), parts.of('id', self.text, ''))

    def _offset(self, node: Any, what: str) -> float:
        return self._clock(node, what) if ':' in self.text(node, what) else self.number(node, what)

    # --- conditions

    def _condition(self, node: Any) -> Condition:
        if is_text(node):
            raise self.fail(node, 'templates are not run by the bench')
        entries = self.entries(node, 'a condition')
        for word in ('and', 'or', 'not'):
            if word in entries:  # the short form
                self._parts(node, word, (word,))
                return Logic(word, self._each(entries[word], self._condition))
        kind = self._kind(node, 'a condition', ('condition',), CONDITIONS)
        if kind in ('and', 'or', 'not'):
            parts = self._parts(node, kind, ('condition', 'conditions'), ('conditions',))
            return Logic(kind, self._each(parts['conditions'], self._condition))
        read = {'state': self._state_condition, 'numeric_state': self._numeric_condition,
                'time': self._time_condition, 'sun': self._sun_condition,
                'trigger': self._trigger_condition}[kind]
        return read(node)

    def _state_condition(self, node: Any) -> Condition:
        parts = self._parts(node, 'a state condition', (
            'condition', 'entity_id', 'state', 'attribute', 'for', 'match'), ('entity_id', 'state'))
        entities = self._ids(parts['entity_id'])
        attribute = self._attribute(parts, entities)
        found = StateCondition(entities, self._states(parts['state'], entities, attribute),
                               attribute, parts.of('for', self._seconds, 0.0))
        if parts.of('match', self.choice, 'all', ('all', 'any')) == 'any':
            return Logic('or', tuple(StateCondition((entity,), found.states, attribute, found.held)
                                     for entity in entities))
        return found

    def _numeric_condition(self, node: Any) -> Condition:
        parts = self._parts(node, 'a numeric_state condition', (
            'condition', 'entity_id', 'above', 'below', 'attribute'), ('entity_id',))
        entities = self._ids(parts['entity_id'])
        return NumericCondition(entities, *self._limits(parts, node),
                                self._attribute(parts, entities))

    def _time_condition(self, node: Any) -> Condition:
        parts = self._parts(node, 'a time condition', ('condition', 'after', 'before', 'weekday'))
        days = tuple(WEEKDAYS.index(self.choice(each, 'weekday', WEEKDAYS))
                     for each in parts.of('weekday', self.nodes, ()))
        return TimeCondition(parts.of('after', self._time), parts.of('before', self._time), days)

    def _sun_condition(self, node: Any) -> Condition:
        parts = self._parts(node, 'a sun condition', ('condition', 'after', 'before',
                                                      'after_offset', 'before_offset'))
        after, before = (parts.of(key, self.choice, '', SUN) for key in ('after', 'before'))
        return SunCondition(after, before, parts.of('after_offset', self._offset, 0.0),
                            parts.of('before_offset', self._offset, 0.0))

    def _trigger_condition(self, node: Any) -> Condition:
        parts = self._parts(node, 'a trigger condition', ('condition', 'id'), ('id',))
        return TriggerCondition(self.texts(parts['id'], 'id'))

    # --- actions

    def _action(self, node: Any) -> Action:
        entries = self.entries(node, 'an action')
        word = next((key for key in ACTIONS if key in entries), '')
        if not word:
            key = next((key for key in entries if key not in NOTED), '')
            raise self.fail(node, f"the bench does not run '{key}'; it runs {', '.join(ACTIONS)}")
        if word in ('condition', 'and', 'or', 'not'):
            return Test(self._condition(node))
        read = {'service': self._service, 'action': self._service, 'delay': self._delay,
                'wait_for_trigger': self._wait, 'if': self._if, 'choose': self._choose,
                'stop': self._stop}[word]
        return read(node, word)

    def _service(self, node: Any, word: str) -> Action:
        parts = self._parts(node, 'a service', (word, 'target', 'data', 'entity_id', 'metadata'))
        name = self.text(parts[word], word)
        if not is_known(name):
            raise self.fail(parts[word], f"the bench has no service '{name}'; "
                            + did_you_mean(name, SERVICES))
        data = parts.of('data', self.entries, Entries())
        ids = parts.get('entity_id', data.pop('entity_id', None))
        if 'target' in parts:
            ids = self.entries(parts['target'], 'target', ('entity_id',), ('entity_id',))[
                'entity_id']
        for key in data:
            if key not in data_of(name):
                raise self.fail(data[key], f"'{key}' is not known in data of {name}; "
                                + did_you_mean(key, data_of(name)))
        texts = tuple((key, self.text(each, key)) for key, each in data.items())
        found = Service(name, self._targets(node, name, ids), texts,
                        Where(self.path, line_of(node)))
        self._check(node, found)
        return found

    def _targets(self, node: Any, name: str, ids: Any) -> tuple[str, ...]:
        domain = name.partition('.')[0]
        if domain in NOTES:
            return ()
        if ids is None:
            raise self.fail(node, f'{name} has no entity_id')
        if is_text(ids) and ids.value == 'all':
            return tuple(sorted(one for one in self._entities.all
                                if one.startswith(f'{domain}.')))
        return self._ids(ids)

    def _check(self, node: Any, service: Service) -> None:
        """Whether the entities take it."""
        for name in service.entities:
            try:
                part, payload = order_of(service.name, self._entities.find(name),
                                         dict(service.data))
                if part.verb and payload not in part.commands:
                    low, high = part.low, part.high
                    if not low <= float(payload) <= high:
                        raise Failure(f'{payload} is not a number of {low:g} to {high:g}')
            except (Failure, ValueError) as error:
                raise self.fail(node, str(error)) from None

    def _delay(self, node: Any, word: str) -> Action:
        return Delay(self._seconds(self._parts(node, 'a delay', (word,))[word], word))

    def _wait(self, node: Any, word: str) -> Action:
        parts = self._parts(node, word, (word, 'timeout', 'continue_on_timeout'))
        return Wait(self._each(parts[word], self._trigger), parts.of('timeout', self._seconds),
                    parts.of('continue_on_timeout', self.flag, True))

    def _if(self, node: Any, word: str) -> Action:
        parts = self._parts(node, 'if', ('if', 'then', 'else'), ('then',))
        return Choice(((self._each(parts['if'], self._condition),
                        self._each(parts['then'], self._action)),),
                      self._each(parts.get('else'), self._action))

    def _choose(self, node: Any, word: str) -> Action:
        parts = self._parts(node, 'choose', ('choose', 'default'))

        def option(each: Any) -> Any:
            both = self._parts(each, 'an option', ('conditions', 'sequence'),
                               ('conditions', 'sequence'))
            return (self._each(both['conditions'], self._condition),
                    self._each(both['sequence'], self._action))

        return Choice(self._each(parts['choose'], option),
                      self._each(parts.get('default'), self._action))

    def _stop(self, node: Any, word: str) -> Action:
        self._parts(node, 'stop', ('stop',))
        return Stop()
