"""Services of Home Assistant: the part of an entity that one commands, and the payload."""
from typing import Any

from angen_apps.automation.entities import Entity
from angen_apps.mqtt.table import Part
from angen_tools.common.failure import Failure

SWITCHED = ('light', 'switch', 'fan')
NOTES = ('notify', 'persistent_notification')  # domains whose services only say something
TOGGLES = {'turn_on': 'ON', 'turn_off': 'OFF', 'toggle': ''}
# By service: the role of the part, and the word of its data, or else the payload.
SERVICES: dict[str, tuple[str, str, str]] = {
    'cover.open_cover': ('', '', 'OPEN'), 'cover.close_cover': ('', '', 'CLOSE'),
    'cover.stop_cover': ('', '', 'STOP'), 'cover.set_cover_position': ('position', 'position', ''),
    'climate.set_temperature': ('temperature', 'temperature', ''),
    'fan.set_percentage': ('percentage', 'percentage', ''),
    'number.set_value': ('', 'value', ''), 'button.press': ('', '', 'PRESS'),
    'select.select_option': ('', 'option', ''),
    **{f'{domain}.{verb}': ('', '', payload) for domain in (*SWITCHED, 'homeassistant')
       for verb, payload in TOGGLES.items()}}
DATA = {'light.turn_on': ('brightness_pct', 'brightness'), 'fan.turn_on': ('percentage',)}


def data_of(name: str) -> tuple[str, ...]:
    """The words of a service's data."""
    if name.partition('.')[0] in NOTES:
        return ('message', 'title')
    return DATA.get(name, tuple(filter(None, (SERVICES[name][1],))))


def is_known(name: str) -> bool:
    return name in SERVICES or (name.partition('.')[0] in NOTES and name.count('.') == 1)


def order_of(name: str, entity: Entity, data: dict[str, Any]) -> tuple[Part, str]:
    """The part that a service commands, and the payload; Failure if the entity has none."""
    domain = name.partition('.')[0]
    if domain not in (entity.domain, 'homeassistant'):
        raise Failure(f'{name} is for entities of {domain}, and {entity.id} is none')
    role, word, payload = SERVICES[name]
    if data.get('brightness_pct') or data.get('brightness'):
        role = 'brightness'
        payload = data.get('brightness_pct') or f'{float(data["brightness"]) / 2.55:.1f}'
    elif data.get('percentage'):
        role, payload = 'percentage', data['percentage']
    elif word:
        payload = data.get(word, '')
    part = entity.part(role)
    if part is None or not part.takes_commands or (word and not payload):
        raise Failure(f'{entity.id} does not take {name}' + f' without {word}' * bool(word))
    if name.endswith('.toggle'):
        payload = 'OFF' if entity.state == 'on' else 'ON'
    return part, payload
