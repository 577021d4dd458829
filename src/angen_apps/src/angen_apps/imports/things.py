"""Finds the thing, model and shape of a piece of furniture by words in its name."""
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from angen_apps.shipped import shipped
from angen_tools.common.yaml_file import YamlFile

SHAPES = ('box', 'cylinder', 'stairs', 'curved_stairs', 'tray', 'flat')


@dataclass(frozen=True)
class Entry:
    """An entry of the table."""

    word: str
    thing: str
    model: str
    shape: str
    unless: tuple[str, ...]  # names of pieces that are something else


@cache
def table(own: Path | None = None) -> tuple[Entry, ...]:
    """The entries of a user's file, then ours."""
    found: list[Entry] = []
    for path in ([own] if own else []) + [shipped('things.yaml')]:
        file = YamlFile(path)
        for node in file.list(file.root, 'the table'):
            found.append(_entry(file, node))
    return tuple(found)


def _entry(file: YamlFile, node: object) -> Entry:
    values = file.entries(node, 'an entry', ('word', 'thing', 'model', 'shape', 'unless'),
                          ('word',))

    def word(key: str) -> str:
        value = values.get(key)
        return str(value.value).strip() if value is not None else ''

    unless = tuple(file.text(item, 'a name').lower()
                   for item in values.of('unless', file.list, ()))
    return Entry(file.text(values['word'], 'word').lower(), word('thing'), word('model'),
                 values.of('shape', file.choice, 'box', SHAPES), unless)


def what_is(entries: tuple[Entry, ...], catalog: str, name: str) -> Entry | None:
    """The first entry that fits a piece, by its name, then by its catalog id."""
    name, catalog = name.lower().strip(), catalog.lower().rpartition('#')[2]
    for text in (name, catalog):
        for entry in entries:
            if entry.word in text and name not in entry.unless:
                return entry
    return None
