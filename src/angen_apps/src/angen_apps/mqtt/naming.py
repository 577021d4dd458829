"""Names of things as people say them, and as topics have them."""
import re
from functools import lru_cache
from typing import Iterable, Sequence

from angen_apps.mqtt.table import table, words_of
from angen_tools.common.home import Home

SUFFIX = re.compile(r'(\D+?)(\d+)((?:_.*)?)')  # kitchen, 0 and _a of kitchen0_a
UPPER = ('upstairs', 'floor {}')  # in a home with two storeys, and in a higher one
LONGEST = 100  # characters of a name in topics and labels


@lru_cache(10_000)
def slug(name: str) -> str:
    """A name in a topic or id: bytes that are neither letters nor digits are written _xHH, as in
    topics of ROS."""
    return ''.join(c if c.isascii() and (c.isalnum() or c == '_')
                   else ''.join(f'_x{byte:02x}' for byte in c.encode()) for c in name)


def title(words: Iterable[str]) -> str:
    """'Living room TV': single letters and words with capitals stay."""
    text = ' '.join(word for word in words if word)
    return text[:1].upper() + text[1:]


def _spelled(text: str) -> list[str]:
    spelling = table()['spelling']
    return [spelling.get(word.lower(), word.upper() if len(word) == 1 else word)
            for word in re.findall(r'\d+|[^\W\d_]+|[^\w\s]+', text)]


def _on_floor(name: str, home: Home) -> tuple[str, str]:
    """A name without the number of its floor, and the words for that floor; '' of floor 0."""
    found = SUFFIX.fullmatch(name)
    numbers = [storey.number for storey in home.storeys]
    if found is None or int(found[2]) not in numbers:
        return name, ''
    number = int(found[2])
    return found[1] + found[3], UPPER[len(numbers) > 2].format(number) if number else ''


def area(room: str, home: Home) -> str:
    """The name of a room: Kitchen, Upstairs kitchen."""
    plain, floor = _on_floor(room, home)
    return title([floor, *_spelled(plain)])[:LONGEST]


def label(kind: str, name: str, home: Home) -> str:
    """The name of a thing: Kitchen lamp, Upstairs bedroom motion sensor A."""
    plain, floor = _on_floor(name, home)
    words, noun, drop = _spelled(plain), words_of(kind)['noun'], words_of(kind)['drop']
    tail = [words.pop()] if len(words) > 1 and re.fullmatch('[A-Z]', words[-1]) else []
    words = [word for word in words if word.lower() not in drop] or words
    if noun and noun.lower() not in ' '.join(words).lower():
        words.append(noun)
    text = title([floor, *words, *tail])
    return ''.join(c if c.isprintable() else '?' for c in text)[:LONGEST]


def distinct(labels: Sequence[tuple[str, str]]) -> list[str]:
    """Labels of things; those that several share are followed by the things' names."""
    plain = [text for text, _ in labels]
    return [text if plain.count(text) == 1 else f'{text} ({name[:LONGEST]})'
            for text, name in labels]
