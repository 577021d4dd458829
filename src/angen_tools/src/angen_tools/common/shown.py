"""The values in the words of /angen/summary, with their units."""
from typing import Any, Mapping

BETWEEN = '  '  # two fields


def values_of(kind: Mapping[str, Any] | None, text: str) -> dict[str, dict[str, Any]]:
    """By field: its value as a flag, a number, a list, numbers by name, or text, and its unit.
    Empty where the text is not of the fields that the kind shows, such as an error."""
    parts = text.split(BETWEEN) if text else []
    fields = [field for field in kind['fields'] if field['shown']] if kind else []
    if not fields:  # such a kind shows all as name=value
        named = [part.partition('=') for part in parts]
        return {name: {'value': _value(value, ''), 'unit': ''} for name, is_, value in named if is_}
    if len(parts) != len(fields):
        return {}
    return {field['name']: _shown(field, part) for field, part in zip(fields, parts)}


def _shown(field: Mapping[str, Any], part: str) -> dict[str, Any]:
    if field['type'] == 'flag' and part in field['words']:
        return {'value': part == field['words'][0], 'unit': ''}
    unit = '%' if part.endswith(' %') else field['unit']
    text = part.removesuffix(' ' + unit) if unit else part
    value = _value(text, field['type'])
    return {'value': value, 'unit': '' if isinstance(value, (str, bool)) else unit}


def _value(text: str, kind: str) -> Any:
    if kind in ('numbers', 'texts') and text == 'none':
        return []
    if kind == 'flag' and text in ('yes', 'no'):
        return text == 'yes'
    try:
        if ', ' in text:
            pairs = [part.rpartition(' ') for part in text.split(', ')]
            return {name: float(number) for name, _, number in pairs}
        numbers = [float(word) for word in text.split(' ')]
    except ValueError:
        return text
    return numbers if kind == 'numbers' else numbers[0] if len(numbers) == 1 else text
