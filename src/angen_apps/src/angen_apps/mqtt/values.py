"""Values of parts: from fields of states, and from what is received."""
import json
import math
from typing import Any, Mapping

from angen_apps.mqtt.table import Part

Value = bool | float | str | None
LONGEST = 255  # characters of a text; Home Assistant takes no longer state
STICKY = 0.8  # share of the last decimal
FLAGS = {'on': True, 'true': True, '1': True, 'off': False, 'false': False, '0': False}


def value_of(part: Part, fields: Mapping[str, Any], before: Value = None) -> Value:
    """The value of a part, None while it is not known; rounded, and as before if it differs by
    less than the last decimal: noise is no change."""
    if part.constant:
        return part.constant
    found = fields.get(part.field)
    if isinstance(found, (list, tuple)):
        found = _of_list(part, found)
    if found is None:
        return None
    if part.over:
        found = abs(found) > part.over
    if part.words:  # a summary has floors as 1.0
        word = f'{found:g}' if isinstance(found, float) else str(found)
        return part.words.get(word, word)
    if part.type == 'flag':
        return None if math.isnan(found) else bool(found) != part.invert
    if isinstance(found, str):
        return found[:LONGEST]
    return _number(part, float(found), fields, before)


def _of_list(part: Part, elements: Any) -> Any:
    if part.index is not None:
        return elements[part.index] if part.index < len(elements) else None
    if part.each == 'all':
        return ', '.join(map(str, elements))
    numbers = [each for each in elements if math.isfinite(each)]
    if not numbers:
        return None
    return max(numbers) if part.each == 'greatest' else sum(numbers) / len(numbers)


def _number(part: Part, found: float, fields: Mapping[str, Any], before: Value) -> Value:
    if not math.isfinite(found):
        return None
    if part.share:
        whole = abs(fields.get(part.share, math.nan))
        if not whole > 0.0:  # also NaN
            return None
        found = min(100.0 * abs(found) / whole, 100.0)
    found *= part.scale
    if isinstance(before, float) and abs(found - before) < STICKY * 10.0 ** -part.decimals:
        return before
    return round(found, part.decimals) + 0.0  # no -0.0


def plain(value: Value, part: Part) -> str:
    """A value as the payload of its own topic; None is what Home Assistant takes as unknown."""
    if isinstance(value, bool):
        return 'ON' if value else 'OFF'
    if part.json and value is not None:
        return json.dumps({'state': value})
    return f'{value:.{part.decimals}f}' if isinstance(value, float) else str(value)


def command_of(part: Part, payload: str, fields: Mapping[str, Any]) -> list[str]:
    """The commands that a payload means, of which the first that is accepted holds; ValueError
    with what would be right."""
    payload = payload.strip()
    for word, text in part.commands.items():
        if payload.lower() == word.lower() or (
                word in ('ON', 'OFF') and FLAGS.get(payload.lower()) is (word == 'ON')):
            return [_filled(text, fields)]
    if not part.verb:
        raise ValueError(f"'{payload:.80}' is none of {', '.join(part.commands)}")
    try:
        number = float(payload)
    except ValueError:
        number = math.nan
    low, high = part.low, part.high
    if not low <= number <= high or not math.isfinite(number):
        limits = f' of {low:g} to {high:g}' if math.isfinite(high - low) else ''
        raise ValueError(f"'{payload:.80}' is not a number{limits}")
    if not part.share:
        return [f'{part.verb} {number / part.scale:.10g}']
    angle = number / 100.0 * abs(_known(fields, part.share))
    opened = fields.get(part.field, 0.0)  # the side to which it opens is seen when it is open
    sign = 1.0 if opened > 0.1 else -1.0
    return [f'{part.verb} {side * angle:.6g}' for side in (sign, -sign)]


def _filled(text: str, fields: Mapping[str, Any]) -> str:
    before, brace, rest = text.partition('{')
    if not brace:
        return text
    name, _, after = rest.partition('}')
    return f'{before}{_known(fields, name):.6g}{after}'


def _known(fields: Mapping[str, Any], name: str) -> float:
    found = fields.get(name)
    if found is None or not math.isfinite(found):
        raise ValueError(f'its {name} is not known')
    return float(found)


def flat_json(payload: str) -> dict[str, str]:
    """The entries of a JSON object as texts; ValueError if it is something else."""
    try:
        read = json.loads(payload)
    except (ValueError, RecursionError):
        raise ValueError(f"'{payload:.80}' is not JSON") from None
    if not isinstance(read, dict):
        raise ValueError(f"'{payload:.80}' is not a JSON object")
    return {str(key): ('ON' if each else 'OFF') if isinstance(each, bool) else str(each)
            for key, each in read.items()}
