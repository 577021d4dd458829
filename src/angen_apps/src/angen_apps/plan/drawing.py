"""A plan as JSON: a world contains the one that it was written from, so that it can be edited."""
import hashlib
import json
import re
import typing
from copy import deepcopy
from dataclasses import MISSING, dataclass, fields, is_dataclass, replace
from functools import cache
from types import UnionType
from typing import Any

from angen_apps.plan.finish import room_at
from angen_apps.plan.model import Opening, Piece, Plan, Storey
from angen_apps.plan.names import stem
from angen_apps.plan.passages import PASSAGE
from angen_tools.common.failure import Failure
from angen_tools.common.text_file import shortened

FARTHEST = 500.0  # m from the origin
GREATEST = 1e5  # the greatest other number
LONGEST = 200  # characters of a text
MOST = 5000  # entries of a list
SENSORS = ('seed', 'casas', 'none')
CHOICES = {('Opening', 'kind'): ('door', 'window', 'opening'),
           ('Mover', 'kind'): ('person', 'robot'),
           ('Planned', 'days'): ('all', 'weekday', 'weekend'),
           ('Piece', 'shape'): ('box', 'cylinder', 'stairs', 'curved_stairs', 'tray', 'shell',
                                'flat')}
PLAIN = {('Piece', 'model'): r'\w*', ('Sensor', 'model'): r'\w+', ('Piece', 'thing'): r'\w*',
         ('Piece', 'mesh'): r'(?!.*\.\.)[\w./ -]*', ('Room', 'use'): r'\w*',
         ('Label', 'use'): r'\w*', ('Mover', 'habits'): r'\w*',
         ('Plan', 'start'): r'[-\dT:]*'}
LENGTHS = ('thickness', 'width', 'height', 'depth', 'slab', 'flux', 'ceiling', 'doorway',
           'low', 'high', 'chance')  # >= 0
MARK = '<!-- angen drawing '
KEPT = re.compile(re.escape(MARK) + r'([0-9a-f]{64}) (\{.*\}) -->\n\Z')


@dataclass
class Drawing:
    """A plan as it was drawn or read, with the rule for sensors beside its own."""

    plan: Plan
    sensors: str = 'seed'


def drawing_of(plan: Plan, sensors: str) -> Drawing:
    """The drawing of a plan that is finished: without the names and passages that finish() adds.
    """
    return Drawing(Plan(plan.name, [_drawn(storey) for storey in plan.storeys], plan.north,
                        plan.latitude, plan.start, lifts=plan.lifts), sensors)


def _drawn(storey: Storey) -> Storey:
    made = deepcopy(storey)
    made.rooms = [replace(room, name=stem(room.name)) for room in storey.rooms]
    made.openings = [replace(opening, name='' if _is_named_by_room(opening, storey)
                             else opening.name)
                     for opening in storey.openings if opening.source != PASSAGE]
    made.pieces = [replace(piece, name=_without_room(piece, storey)) for piece in storey.pieces]
    made.lamps = [replace(lamp, name='' if room_at(storey, (lamp.x, lamp.y)) is not None
                          else stem(lamp.name)) for lamp in storey.lamps]
    return made


def _is_named_by_room(opening: Opening, storey: Storey) -> bool:
    return opening.name.endswith(str(storey.number)) and opening.name != opening.source


def _without_room(piece: Piece, storey: Storey) -> str:
    room = room_at(storey, (piece.x, piece.y))
    name = stem(piece.name)
    return name.removeprefix(f'{stem(room.name)}_') if room is not None else name


def to_json(drawing: Drawing) -> dict[str, Any]:
    """The drawing as JSON has it: fields that have their defaults are left out."""
    return {'plan': _plain(drawing.plan), 'sensors': drawing.sensors}


def _plain(value: Any) -> Any:
    if is_dataclass(value):
        return {f.name: _plain(held) for f in fields(value)
                if (held := getattr(value, f.name)) != _default(f) and f.name not in LEFT_OUT}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value + 0.0 if isinstance(value, float) else value  # -0.0 is 0 in JavaScript's JSON


LEFT_OUT = ('remarks', 'meshes', 'entrances')  # fields of a plan


def _default(field: Any) -> Any:
    return field.default_factory() if field.default_factory is not MISSING else field.default


def from_json(data: Any, what: str) -> Drawing:
    """The drawing; Failure that begins with `what` and names the wrong part."""
    if not isinstance(data, dict) or not set(data) <= {'plan', 'sensors'} or 'plan' not in data:
        raise Failure(f'{what}: must be {{"plan": …, "sensors": …}}')
    if data.get('sensors', 'seed') not in SENSORS:
        raise Failure(f'{what}: sensors must be {", ".join(SENSORS)}')
    plan = _read(Plan, data['plan'], f'{what}: plan')
    numbers = [storey.number for storey in plan.storeys]
    if not numbers or len(set(numbers)) < len(numbers):
        raise Failure(f'{what}: plan.storeys need numbers of their own, at least one')
    for i, lift in enumerate(plan.lifts):
        if not lift.stops or not set(lift.stops) <= set(numbers):
            raise Failure(f'{what}: plan.lifts[{i}].stops must be numbers of storeys, at least one')
    return Drawing(plan, data.get('sensors', 'seed'))


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return typing.get_type_hints(kind)


def _read(hint: Any, data: Any, at: str) -> Any:
    """The value of a type, which JSON gives."""
    if is_dataclass(hint):
        return _record(hint, data, at)
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if origin in (UnionType, typing.Union):
        return None if data is None else _read(inner[0], data, at)
    if origin in (list, tuple):
        if not isinstance(data, list) or len(data) > MOST:
            raise Failure(f'{at} must be a list of at most {MOST}')
        if origin is list or inner[-1] is Ellipsis:
            return origin(_read(inner[0], item, f'{at}[{i}]') for i, item in enumerate(data))
        if len(data) != len(inner):
            raise Failure(f'{at} must be a list of {len(inner)}')
        return tuple(_read(kind, item, f'{at}[{i}]') for i, (kind, item) in enumerate(
            zip(inner, data)))
    return _scalar(hint, data, at)


def _scalar(hint: Any, data: Any, at: str) -> Any:
    if hint is bool and isinstance(data, bool):
        return data
    is_number = isinstance(data, (int, float)) and not isinstance(data, bool)
    if hint is int and is_number and abs(data) <= MOST and data == int(data):
        return int(data)
    if hint is float and is_number and abs(data) <= GREATEST:
        return float(data)
    if hint is str and isinstance(data, str) and len(data) <= LONGEST and data.isprintable():
        return data
    wanted = {bool: 'true or false', int: f'a whole number up to {MOST}',
              float: f'a finite number up to {GREATEST:g}',
              str: f'a text of at most {LONGEST} characters, none of them of control'}
    raise Failure(f'{at} is {shortened(json.dumps(data))}, must be {wanted[hint]}')


def _record(kind: Any, data: Any, at: str) -> Any:
    known = {f.name: f for f in fields(kind) if f.name not in LEFT_OUT}
    if not isinstance(data, dict):
        raise Failure(f'{at} must be an object with {", ".join(known)}')
    for key in data:
        if key not in known:
            raise Failure(f'{at}: {shortened(str(key))} is not known; it has {", ".join(known)}')
    for key, field in known.items():
        if key not in data and _default(field) is MISSING:
            raise Failure(f'{at} has no {key}')
    values = {key: _read(_hints(kind)[key], value, f'{at}.{key}') for key, value in data.items()}
    for key, value in values.items():
        _check(kind.__name__, key, value, f'{at}.{key}')
    return kind(**values)


def _check(kind: str, key: str, value: Any, at: str) -> None:
    choices = CHOICES.get((kind, key))
    if choices and value not in choices:
        raise Failure(f'{at} is {shortened(value)}, must be {", ".join(choices)}')
    if not re.fullmatch(PLAIN.get((kind, key), '(?s).*'), value if isinstance(value, str) else ''):
        raise Failure(f'{at} is {shortened(value)}, must have letters, digits and _ only')
    if key in LENGTHS and isinstance(value, float) and value < 0.0:
        raise Failure(f'{at} is {value:g}, must not be negative')
    if key in ('x', 'y', 'z', 'start', 'end', 'polygon', 'elevation', 'bottom', 'top') and any(
            abs(number) > FARTHEST for number in _numbers(value)):
        raise Failure(f'{at} is more than {FARTHEST:g} m from the origin')


def _numbers(value: Any) -> list[float]:
    if isinstance(value, tuple):
        return [number for item in value for number in _numbers(item)]
    return [value] if isinstance(value, float) else []


def kept(world: str, drawing: Drawing) -> str:
    """The text of a world with its drawing at its end."""
    text = json.dumps(to_json(drawing), separators=(',', ':')).replace('--', '-\\u002d')
    digest = hashlib.sha256(world.encode()).hexdigest()
    return f'{world}{MARK}{digest} {text} -->\n'


def recovered(world: str, what: str) -> Drawing:
    """The drawing in the text of a world; Failure that says why there is none."""
    found = KEPT.search(world)
    if found is None:
        raise Failure(f'{what}: was not written by Angen from a plan, or was saved by the '
                      'simulator; it has no drawing to edit')
    if hashlib.sha256(world[:found.start()].encode()).hexdigest() != found[1]:
        raise Failure(f'{what}: was changed by hand after it was written; its drawing is older')
    try:
        data = json.loads(found[2])
    except (ValueError, RecursionError):
        raise Failure(f'{what}: its drawing is not JSON') from None
    return from_json(data, what)
