"""Checks a layout: its openings against its rooms, its residents against the settings, and all of
it against the home of its world."""
from __future__ import annotations

import json
import tempfile
from functools import lru_cache
from pathlib import Path
from typing import Any, Iterator

from angen_apps.data.generate import HOME, described, sha256
from angen_apps.data.run import residents_of
from angen_apps.data.site import Site, apartment
from angen_apps.data.tables import ENTRY, parsed
from angen_apps.data.written import Findings, Written
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import turned
from angen_tools.common.home import Room
from angen_tools.common.text_file import shortened

DEPTHS = [0.05 * i for i in range(1, 25)]  # m from the middle of an opening to one of its rooms
JAMB = 0.15  # m of an opening's side that may be beside a room
BELOW, ABOVE = 1.0, 10.0  # m from a floor to a sensor of its rooms, at most
DIGEST = 64  # characters in the settings instead of a profile of the user's own
PARTS = ('rooms', 'doors', 'landings', 'things', 'sensors')


def check(findings: Findings, home: Written, world: Path | None = None) -> None:
    """All checks of the layout. `world`: the file of a home of the user's own."""
    _openings(findings, home)
    _heights(findings, home)
    path = home.folder / HOME
    if not path.exists():
        return
    entry = parsed(path, ENTRY)
    if entry.get('version') == angen_module().__version__:
        _residents(findings, home, entry['settings'].get('residents'))
        _world(findings, home, entry['settings'], world)


def _openings(findings: Findings, home: Written) -> None:
    """Each door, window and opening is between its rooms."""
    rooms = {name: Room(name, '', 0, room['polygon'], room.get('holes', []), 0.0, 0.0, 0.0, False)
             for name, room in home.rooms.items()}
    for door in home.layout['doors']:
        for name, side in zip(door['rooms'], (1.0, -1.0)):
            if name:
                findings.say('an opening is between its rooms', _leads_to(door, rooms[name], side),
                             f'{door["kind"]} {door["name"]}, {door["width"]:g} m wide at '
                             f'{door["pose"][0]:g} {door["pose"][1]:g}, does not lead to {name}')


def _leads_to(door: Any, room: Room, side: float) -> bool:
    """Whether a room is on a side of an opening, along all of it."""
    x, y, _, yaw = door['pose']
    half = max(door['width'] / 2 - JAMB, 0.0)
    return any(all(room.contains(*turned((x, y), yaw, along, side * depth))
                   for along in (-half, 0.0, half)) for depth in DEPTHS)


def _heights(findings: Findings, home: Written) -> None:
    """Sensors are not far above or below the floors of the doors on their storey."""
    floors: dict[int, float] = {}
    for door in home.layout['doors']:
        for name in (name for name in door['rooms'] if name):
            storey, z = home.rooms[name]['storey'], door['pose'][2]
            if door['kind'] != 'window':
                floors[storey] = min(z, floors.get(storey, z))
    for sensor in home.layout['sensors']:
        floor = floors.get(home.rooms.get(sensor['room'], {}).get('storey'))
        if floor is not None:
            findings.say('sensors are at the height of their floor',
                         -BELOW < sensor['z'] - floor < ABOVE,
                         f'{sensor["name"]} is {sensor["z"] - floor:g} m above the floor')


def _residents(findings: Findings, home: Written, words: Any) -> None:
    """Names, profiles and speeds are those that the settings give, for profiles of Angen."""
    if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
        return
    check = 'residents are those of the settings'
    own = [len(word) == DIGEST for word in words]
    try:
        made = residents_of(['worker' if unknown else word for word, unknown in zip(words, own)])
    except Failure as failure:
        findings.say(check, False, f'{HOME}: {failure}')
        return
    people = home.layout['residents']
    findings.say(check, [one['name'] for one in people] == [name for name, _ in made],
                 f'layout.json has {", ".join(one["name"] for one in people)}, {HOME} '
                 f'{", ".join(name for name, _ in made)}')
    for i, (one, (name, profile)) in enumerate(zip(people, made)):
        if i < len(own) and own[i] and len(made) == len(own):
            continue
        has = [one.get('profile', ''), one.get('body', 'person'), one['speed']]
        findings.say(check, has == [profile.name, profile.body, profile.speed],
                     f'{name}: layout.json has {" ".join(map(str, has))}, by {HOME} it is '
                     f'{profile.name} {profile.body} {profile.speed}')


def _world(findings: Findings, home: Written, settings: Any, world: Path | None) -> None:
    """Rooms, doors, things and sensors are those of the world. A world of the user's own is not in
    the folder."""
    check = 'the layout is that of its world'
    if world is not None and sha256(world) != settings['world']:
        findings.say(check, False, f'{world} is not the world of the data')
        return
    if settings['world'] and world is None:
        return
    made = json.loads(_made(str(world or ''), settings['seed'],
                            not settings['own_sensors'], settings['light']))
    for part in PARTS:
        own = home.layout.get(part, [])
        findings.say(check, len(own) == len(made[part]),
                     f'layout.json has {len(own)} {part}, the world {len(made[part])}')
        for i, (one, right) in enumerate(zip(own, made[part])):
            findings.say(check, one == right, f'{part}[{i}]: {_differs(one, right)}')


def _differs(one: dict[str, Any], right: dict[str, Any]) -> str:
    """The first value that differs."""
    def texts() -> Iterator[str]:
        for key in sorted({*one, *right}):
            if one.get(key) != right.get(key):
                yield (f'{key} is {shortened(str(one.get(key)))}, in the world '
                       f'{shortened(str(right.get(key)))}')
    return next(texts(), '')


@lru_cache(maxsize=8)
def _made(world: str, seed: int, placed: bool, light: bool) -> str:
    """The layout of a world as generate writes it; '': of the apartment."""
    with tempfile.TemporaryDirectory(prefix='angen_') as scratch:
        path = Path(world or f'{scratch}/home.world')
        if not world:
            apartment(path)
        site = Site(path, seed, placed, light)
    return json.dumps(described(site.home, site.sensors))
