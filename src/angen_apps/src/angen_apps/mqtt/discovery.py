"""The messages from which Home Assistant makes its entities."""
import json
from typing import Any

from angen_apps.mqtt.naming import slug
from angen_apps.mqtt.styles import Style, Topics
from angen_apps.mqtt.table import Component, Part
from angen_apps.mqtt.things import Thing, noun

ROOT = 'homeassistant'
MAKER = 'Angen'
WHOLE = ('light', 'fan')  # whose template of the state has a longer name
# Of each role: the topic of its state, the template of that, the topic of its commands.
TOPICS = {'': ('state_topic', 'value_template', 'command_topic'),
          'brightness': ('brightness_state_topic', 'brightness_value_template',
                         'brightness_command_topic'),
          'percentage': ('percentage_state_topic', 'percentage_value_template',
                         'percentage_command_topic'),
          'position': ('position_topic', 'position_template', 'set_position_topic'),
          'mode': ('mode_state_topic', 'mode_state_template', 'mode_command_topic'),
          'temperature': ('temperature_state_topic', 'temperature_state_template',
                          'temperature_command_topic'),
          'current_temperature': ('current_temperature_topic', 'current_temperature_template',
                                  '')}


class Discovery:
    """Of all things in one style; `node` is the word between component and object."""

    def __init__(self, style: Style, by_device: bool, version: str) -> None:
        self._style, self._by_device, self._version = style, by_device, version
        self._node = slug(style.base)

    def messages(self, thing: Thing) -> Topics:
        """The retained messages of a thing, by topic."""
        shared = {'device': self._device(thing),
                  'origin': {'name': MAKER, 'sw_version': self._version}, **self._availability()}
        entities = [(each, self._entity(thing, each)) for each in thing.components]
        name = f'{slug(thing.kind)}_{slug(thing.name)}'
        if self._by_device:
            found = {f'{component.component}_{component.key}':
                     {'platform': component.component, **entity}
                     for component, entity in entities}
            return {f'{ROOT}/device/{self._node}/{name}/config':
                    text({**shared, 'components': found})}
        return {f'{ROOT}/{component.component}/{self._node}/{name}_{component.key}/config':
                text({**entity, **shared}) for component, entity in entities}

    def _device(self, thing: Thing) -> dict[str, Any]:
        return {'identifiers': [self._id(thing)], 'name': thing.label, 'manufacturer': MAKER,
                'model': noun(thing), 'sw_version': self._version,
                **({'suggested_area': thing.area} if thing.area else {})}

    def _availability(self) -> dict[str, Any]:
        topic: dict[str, Any] = {'topic': f'{self._style.base}/bridge/state'}
        if self._style.online.startswith('{'):
            topic['value_template'] = '{{ value_json.state }}'
        return {'availability': [topic]}

    def _id(self, thing: Thing) -> str:
        return f'{self._node}_{slug(thing.kind)}_{slug(thing.name)}'

    def _entity(self, thing: Thing, component: Component) -> dict[str, Any]:
        config: dict[str, Any] = {
            'name': component.name, 'unique_id': f'{self._id(thing)}_{component.key}',
            **component.config, **self._style.payloads(component.component, component.parts[0])}
        for part in component.parts:
            config |= self._topics(thing, component, part)
        if component.component == 'light':
            config |= {'brightness_scale': self._style.brightness, 'on_command_type': 'brightness'}
        if component.component == 'climate':
            low_high = next(part for part in component.parts if part.role == 'temperature')
            config |= {'min_temp': low_high.low, 'max_temp': low_high.high}
        if component.component == 'button':
            config['payload_press'] = next(iter(component.parts[0].commands))
        return config

    def _topics(self, thing: Thing, component: Component, part: Part) -> dict[str, str]:
        role = 'mode' if component.component == 'climate' and not part.role else part.role
        state, template, command = TOPICS[role]
        if component.component in WHOLE and not role:
            template = 'state_value_template'
        found = {}
        if part.field:
            found[state] = self._style.topic(thing, part)
            if part.event and self._style.template(part):
                found[state] += f'/{part.key}'
            elif self._style.template(part) and not part.json:
                found[template] = self._style.template(part)
        if part.takes_commands:
            found[command] = self._style.command_topic(thing, part)
        return found


def text(config: dict[str, Any]) -> str:
    return json.dumps(config, ensure_ascii=False, separators=(',', ':'))
