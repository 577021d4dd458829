"""Commands to devices in the words of their kind: its verbs in the catalog."""
import math
import re
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, Sequence

from angen_tools.common.angle import in_radians, warn_of_turns
from angen_tools.common.catalog import Plugin


ALIKE = 0.7  # likeness of a misspelled verb and the one that was meant
DECIMAL_COMMA = re.compile(r'(?<![\d.,])\d+,\d+(?![\d.,])')


@dataclass(frozen=True)
class Order:
    """A command in the words that the simulator takes; for numbers alone `verb` is empty."""

    text: str
    verb: dict[str, Any]
    number: float = 0.0


def parse(kind: Plugin, words: Sequence[str]) -> Order:
    """The command that `words` mean to a device of a kind; ValueError lists the right ones.

    A verb in upper or lower case; its number after it, or alone where one verb takes a number; or
    the numbers of a kind that takes numbers alone.
    """
    given = ' '.join(words).replace(',', ' ').replace(' %', '%').split()
    verb = next((v for v in kind['verbs'] if given and v['name'].lower() == given[0].lower()), None)
    if verb is not None:
        return _with_verb(kind, verb, given[1:])
    if kind['values'] and len(given) == len(kind['values']):
        words = [_plain(unit, word) for unit, word in zip(kind['values'], given)]
        if all(math.isfinite(number(word)) for word in words):
            return Order(' '.join(words), {})
    counted = _counted(kind, given)
    if counted is not None:
        return counted
    with_number = [v for v in kind['verbs'] if v['argument']]
    if len(with_number) == 1 and len(given) == with_number[0].get('count', 1) and all(
            math.isfinite(number(in_radians(word.removesuffix('%')))) for word in given):
        return _with_verb(kind, with_number[0], given)
    raise ValueError(f"'{' '.join(words)}' is not a command of {article(kind['kind'])}, "
                     f'which takes {forms_in_words(kind)}{_misspelled(kind, given)}'
                     f'{comma_hint(" ".join(words))}')


def _misspelled(kind: Plugin, given: Sequence[str]) -> str:
    """For the end of an error: the verb that the first word is like; else ''."""
    known = [verb['name'].lower() for verb in kind['verbs']]
    likely = get_close_matches(given[0].lower(), known, 1, ALIKE) if given else []
    return f'; did you mean {" ".join([*likely, *given[1:]])}?' if likely else ''


def _counted(kind: Plugin, given: Sequence[str]) -> Order | None:
    """The parts of "Floor1": an integer may follow its verb without a blank."""
    for verb in kind['verbs']:
        if len(given) == 1 and verb['type'] == 'integer' \
                and given[0].lower().startswith(verb['name'].lower()):
            return _with_verb(kind, verb, [given[0][len(verb['name']):]])
    return None


def _with_verb(kind: Plugin, verb: dict[str, Any], rest: Sequence[str]) -> Order:
    takes = f'{article(kind["kind"])} takes {forms_in_words(kind)}'
    if not verb['argument']:
        if rest:
            raise ValueError(f"'{' '.join(rest)}' is unexpected after {verb['name'].lower()}; "
                             f'{takes}')
        return Order(verb['name'], verb)
    named = bool(rest) and math.isnan(number(rest[0]))
    if verb.get('place') and (named or (not rest and verb['optional'])):
        return Order(' '.join([verb['name'], *rest]), verb)
    count = verb.get('count', 1)
    if len(rest) != count and not (verb.get('place') and len(rest) == count + 1):
        numbers_of = 'one number of' if count == 1 else f'{count} numbers,'
        raise ValueError(f'{verb["name"].lower()} takes {numbers_of} {verb["argument"]}; {takes}')
    words = [_plain(verb['unit'], word) for word in rest]
    numbers = [number(word) for word in words]
    for given, word, value in zip(rest, words, numbers):
        whole = word.isascii() and word.isdigit()
        if not math.isfinite(value) or (verb['type'] == 'integer' and not whole):
            raise ValueError(f"'{given}' is not a number of {verb['argument']}; {takes}")
        if verb['unit'] == '%' and 0.0 < value < 1.0 and given == word:
            raise ValueError(f"'{given}' is {given} percent; give {100 * value:g} for that share "
                             f'of the whole, or {given}%; {takes}')
        if not _bound(verb['min'], -math.inf) <= value <= _bound(verb['max'], math.inf):
            raise ValueError(f"'{given}' is out of range; {takes}")
    return Order(' '.join([verb['name'], *words]), verb, numbers[0])


def _plain(unit: str, word: str) -> str:
    """A number without its unit: of 40% 40, of 90deg rad or rad/s. An angle may be in degrees by
    mistake, which it warns of."""
    if unit == 'rad':
        warn_of_turns(word)
    if unit.startswith('rad'):
        return in_radians(word)
    return word.removesuffix(unit) if unit == '%' else word


def _bound(value: float | None, otherwise: float) -> float:
    return otherwise if value is None else value


def number(word: str) -> float:
    """The number, or NaN."""
    try:
        return float(word)
    except ValueError:
        return math.nan


def comma_hint(text: str) -> str:
    """For the end of an error about numbers, of which one may have a decimal comma; else ''."""
    found = DECIMAL_COMMA.search(text)
    return f'; a decimal has a point: {found[0].replace(",", ".")}' if found else ''


def argument(verb: dict[str, Any]) -> str:
    """Describes the number of a verb: "0 to 100 percent", "radians (rad)"."""
    text: str = verb['argument'] + (' or a name' if verb.get('place') else '')
    if verb['min'] is not None and verb['max'] is not None:
        text = f'{verb["min"]:g} to {verb["max"]:g} {text}'
    elif verb['min'] is not None:
        text = f'{verb["min"]:g} or more {text}'
    return text


def forms(kind: Plugin) -> list[str]:
    """The values that angen set takes, shortest form first: on, off, 0 to 100 percent."""
    with_number = [v for v in kind['verbs'] if v['argument']]
    found = [v['name'].lower() for v in kind['verbs'] if not v['argument']]
    found += [argument(v) if len(with_number) == 1 else f'{v["name"].lower()} {argument(v)}'
              for v in with_number]
    if kind['values']:
        found.append(' and '.join(f'a number of {unit}' for unit in kind['values']))
    return found


def described_forms(kind: Plugin) -> list[tuple[str, str]]:
    """Each form of a command in full, with its meaning: "[dim] PERCENT", "of its full …"."""
    numbered = [verb for verb in kind['verbs'] if verb['argument']]
    found = []
    for verb in kind['verbs']:
        word = verb['name'].lower()
        if verb not in numbered:
            found.append((word, verb['doc']))
            continue
        word = f'[{word}]' if len(numbered) == 1 else word
        or_degrees = ', or degrees as 90deg' if verb['unit'] == 'rad' else ''
        found.append((f'{word} {verb["argument"].upper()}',
                      f'{verb["doc"]}; {argument(verb)}{or_degrees}'))
    if kind['values']:
        found.append((' '.join(unit.upper() for unit in kind['values']), 'numbers alone'))
    return found


def forms_in_words(kind: Plugin) -> str:
    """The forms as a list in a sentence."""
    *first, last = forms(kind)
    return f'{", ".join(first)}{" or " * bool(first)}{last}'


def article(noun: str) -> str:
    """The noun with a or an."""
    return f'{"an" if noun[:1] in "aeiou" else "a"} {noun}'
