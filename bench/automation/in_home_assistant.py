"""Home Assistant's core with its integration MQTT alone, in this process; home_assistant.py runs it
in an environment that has Home Assistant.

    python3 in_home_assistant.py FOLDER BROKER_PORT HTTP_PORT

It prints, as JSON, the number of its entities by domain, those that it has not made, and the states
of the kitchen's lamp and door after it has switched and opened them. If the folder has a dashboard,
ui-lovelace.yaml, it serves that until its input ends.
"""
import asyncio
import json
import logging
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any, Callable

from homeassistant import auth, bootstrap, config_entries, core, loader  # type: ignore[import]
from homeassistant.setup import async_setup_component  # type: ignore[import]

LIMIT = 60.0  # s
LAMP, DOOR = 'light.kitchen_lamp', 'cover.bathroom_door'


class Complaints(logging.Handler):
    """What Home Assistant says about messages."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        if 'mqtt' in record.name:
            self.lines.append(record.getMessage()[:300])


async def until(holds: Callable[[], bool]) -> float:
    """Returns after how many s it holds."""
    began = time.monotonic()
    while not holds():
        if time.monotonic() > began + LIMIT:
            raise TimeoutError
        await asyncio.sleep(0.005)
    return time.monotonic() - began


def onboarded(folder: Path) -> None:
    """Home Assistant asks nothing at its first start."""
    (folder / '.storage').mkdir(exist_ok=True)
    (folder / '.storage/onboarding').write_text(json.dumps({
        'version': 4, 'minor_version': 1, 'key': 'onboarding',
        'data': {'done': ['user', 'core_config', 'analytics', 'integration']}}))


async def started(folder: str, broker: int, http: int) -> Any:
    """Its core with MQTT, and its pages if there is a dashboard, which this machine sees without a
    password."""
    (Path(folder) / 'configuration.yaml').touch()
    has_pages = (Path(folder) / 'ui-lovelace.yaml').exists()
    if has_pages:
        onboarded(Path(folder))
    hass = core.HomeAssistant(folder)
    hass.config.skip_pip = True
    loader.async_setup(hass)
    hass.config_entries = config_entries.ConfigEntries(hass, {})
    await bootstrap.async_load_base_functionality(hass)
    hass.auth = await auth.auth_manager_from_config(hass, [
        {'type': 'trusted_networks', 'trusted_networks': ['127.0.0.1'],
         'allow_bypass_login': True}], [])
    pages = {'lovelace': {'mode': 'yaml'}, 'frontend': {}} if has_pages else {}
    config = {'homeassistant': {}, 'http': {'server_port': http}, **pages}
    for component in config:
        if not await async_setup_component(hass, component, config):
            raise RuntimeError(f'Home Assistant has not set up {component}')
    if has_pages:
        await hass.auth.async_create_user('Anna', group_ids=['system-admin'])
    entry = config_entries.ConfigEntry(
        version=1, minor_version=1, domain='mqtt', title='mqtt', source='user', options={},
        data={'broker': '127.0.0.1', 'port': broker, 'discovery': True,
              'discovery_prefix': 'homeassistant'}, unique_id=None)
    await hass.config_entries.async_add(entry)
    await hass.async_start()
    return hass


async def main() -> None:
    logging.basicConfig(level=logging.ERROR)
    complaints = Complaints()
    logging.getLogger().addHandler(complaints)
    hass = await started(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))

    def state(name: str) -> str:
        found = hass.states.get(name)
        return found.state if found else ''

    appeared = await until(lambda: state(LAMP) == 'off')
    count = -1
    while count != len(hass.states.async_all()):
        count = len(hass.states.async_all())
        await asyncio.sleep(2.0)
    by_domain = Counter(each.domain for each in hass.states.async_all())
    unknown = [each.entity_id for each in hass.states.async_all()
               if each.state == 'unavailable']
    await hass.services.async_call('light', 'turn_on', {'entity_id': LAMP, 'brightness_pct': 40})
    lit = await until(lambda: state(LAMP) == 'on')
    before = state(DOOR)
    moves = 'close_cover' if before == 'open' else 'open_cover'
    await hass.services.async_call('cover', moves, {'entity_id': DOOR})
    opened = await until(lambda: state(DOOR) in ('open', 'closed') and state(DOOR) != before)
    print(json.dumps({
        'entities': sum(by_domain.values()), 'domains': dict(sorted(by_domain.items())),
        'unavailable': unknown, 'appeared after s': round(appeared, 2),
        'lamp on after ms': round(1000 * lit), 'door moved after s': round(opened, 1),
        'brightness': hass.states.get(LAMP).attributes.get('brightness'),
        'complaints': complaints.lines[:20]}), flush=True)
    if (Path(sys.argv[1]) / 'ui-lovelace.yaml').exists():
        await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
    await hass.async_stop(force=True)


if __name__ == '__main__':
    asyncio.run(main())
