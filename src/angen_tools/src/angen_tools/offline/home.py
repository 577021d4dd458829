"""angen home: the description of a world's home, and its missing and wrong parts."""
from typing import Any

from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.home import Door, Home
from angen_tools.common.output import Table, as_json, number, plain, table

Findings = list[tuple[str, str]]  # ('guessed' or 'contradicting', what)


def load_home(path: str) -> tuple[dict[str, Any], Findings]:
    """The home of a world's file; Failure if the world does not load."""
    angen = angen_module()
    try:
        world = angen.World(path)
    except angen.Error as error:
        raise Failure(str(error)) from error
    return world.home, world.home_findings()


def home_json(home: dict[str, Any], findings: Findings) -> str:
    """With the findings as lists of texts, `guessed` and `contradicting`."""
    of = {kind: [text for its, text in findings if its == kind]
          for kind in ('guessed', 'contradicting')}
    return as_json({**home, 'findings': of})


def home_text(described: dict[str, Any], findings: Findings) -> str:
    """Tables of the storeys, rooms, doors, things and elevators, and then the findings."""
    home = Home.of(described)
    latitude = 'not given' if home.latitude is None else f'{home.latitude:g} deg'
    parts = [f'main entrance {home.entrance or "not known"}, north {home.north:.4g} rad from x, '
             f'latitude {latitude}, starts {home.start or "at no given time"}']
    tables = {'storeys': _storeys(home), 'rooms': _rooms(home), 'doors': _doors(home),
              'things': _things(home)}
    parts += [plain(made) for key, made in tables.items() if described[key]]
    for lift in home.elevators:
        stops = ', '.join(f'storey {at.storey} in {at.room or "no room"}' for at in lift.landings)
        parts.append(f'elevator {lift.name}: {stops}')
    parts.append('\n'.join(f'{kind}: {text}' for kind, text in findings) or 'no findings')
    return '\n\n'.join(parts)


def _storeys(home: Home) -> Table:
    rows = [[str(storey.number), storey.name, number(storey.elevation), number(storey.height)]
            for storey in home.storeys]
    return table(('storey', 'name', 'elevation m', 'height m'), rows,
                 right=('storey', 'elevation m', 'height m'))


def _rooms(home: Home) -> Table:
    beside: dict[str, list[str]] = {room.name: [] for room in home.rooms}
    for door in home.doors:
        for room in door.rooms:
            other = door.other(room) or 'outside'
            if door.kind != 'window' and room in beside and other not in beside[room]:
                beside[room].append(other)
    rows = [[room.name, room.use, str(room.storey), number(room.area),
             number(room.ceiling - room.floor), ' '.join(beside[room.name])]
            for room in home.rooms]
    return table(('room', 'use', 'storey', 'area m2', 'height m', 'joined to'), rows,
                 right=('storey', 'area m2', 'height m'))


def _doors(home: Home) -> Table:
    def sides(door: Door) -> str:
        return ' - '.join(room or 'outside' for room in door.rooms)

    rows = [[door.kind, door.name, sides(door), number(door.width), number(door.height)]
            for door in home.doors]
    return table(('passage', 'name', 'between', 'width m', 'height m'), rows,
                 right=('width m', 'height m'))


def _things(home: Home) -> Table:
    rows = [[thing.type, thing.name, thing.room or '-',
             ' '.join(dict.fromkeys(place.posture for place in thing.places))]
            for thing in home.things]
    return table(('thing', 'name', 'room', 'places to'), rows)
