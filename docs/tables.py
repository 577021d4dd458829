#!/usr/bin/env python3
"""Writes docs/reference/, a page for each kind, and the index of devices and sensors in README.md.

    python3 docs/tables.py            writes the pages, names those that changed
    python3 docs/tables.py --check    writes nothing, ends with 1 where a page differs

The text comes from the catalog files beside the plug-in libraries, which the build makes of the
plug-ins' own descriptions; the index comes from the titles of docs/devices/ and docs/sensors/.
"""
import argparse
import json
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

from angen_apps.mqtt.discovery import Discovery
from angen_apps.mqtt.styles import Plain
from angen_apps.mqtt.table import components, is_shown
from angen_apps.mqtt.things import Thing, noun

DOCS = Path(__file__).resolve().parent
README = DOCS.parent / 'README.md'
REFERENCE = DOCS / 'reference'
CATALOG = DOCS.parent / 'devel/lib'
WITH = re.compile(r'with (\w+ \w+): (.*)')  # a parameter that exists only with a value of another
NOTE = '<!-- docs/tables.py writes this file. Its text is in the C++ source of the kind. -->\n\n'

ANY = 'VERSION'
FINITE = {'heating': 21.0}  # a home with heating has all entities of its kind

Kind = dict[str, Any]


def read_catalog(folder: Path = CATALOG) -> dict[str, Kind]:
    files = sorted(folder.glob('*.json'))
    kinds = [kind for file in files for kind in json.loads(file.read_text())]
    if not kinds:
        raise SystemExit(f'docs/tables.py: no catalog in {folder}; run ./angen build first')
    return {kind['kind']: kind for kind in kinds}


def unit(text: str) -> str:
    return text.replace('^2', '²').replace('^3', '³').replace('degC', '°C')


def plain(text: str) -> str:
    """With <elements> as text: Markdown takes them as HTML."""
    return text.replace('<', '&lt;')


def number(text: str) -> str:
    """At most five digits, as 3.1241 for 3.12413936106985."""
    try:
        return f'{float(text):.5g}' if len(text) > 7 else text
    except ValueError:
        return text


def table(heading: str, head: list[str], rows: list[list[str]]) -> str:
    """A section; nothing where it has no rows."""
    lines = [head, ['---'] * len(head), *rows]
    text = ''.join('| ' + ' | '.join(cells) + ' |\n' for cells in lines)
    return f'\n## {heading}\n\n{text}' if rows else ''


def code(text: str) -> str:
    return f'`{text}`' if text else ''


def parameter(param: dict[str, Any]) -> list[str]:
    special = WITH.fullmatch(param['doc'])
    doc = special.group(2) if special else param['doc']
    if param['choices']:
        doc += ': ' + ', '.join(code(choice) for choice in param['choices'])
    elif 'any number of times' in param['type']:
        doc += ' (' + param['type'] + ')'
    return [code(param['path']), number(param['default']), unit(param['unit']), plain(doc)]


def parameters(kind: Kind, beside: set[str]) -> str:
    """A table of those in every variant, and one of those that exist only in a variant."""
    variants: dict[str, list[list[str]]] = {'': []}
    for param in kind['params']:
        if param['path'] not in beside:
            special = WITH.fullmatch(param['doc'])
            variants.setdefault(special.group(1) if special else '', []).append(parameter(param))
    return ''.join(table(f'Parameters with {code(name)}' if name else 'Parameters',
                         ['parameter', 'default', 'unit', ''], rows)
                   for name, rows in variants.items())


def limits(verb: dict[str, Any]) -> str:
    if not verb['argument']:
        return ''
    least, most = verb['min'], verb['max']
    span = '' if least is None or most is None else f'{least:g} to {most:g}'
    return (span + ' ' + unit(verb['unit'])).strip()


def commands(kind: Kind) -> str:
    return table('Commands', ['command', 'range', ''], [
        [code(verb['name'] + (f' {verb["argument"].upper()}' if verb['argument'] else '')),
         limits(verb), plain(verb['doc'])] for verb in kind['verbs']])


def fields(kind: Kind) -> str:
    rows = []
    for field in kind['fields']:
        doc = field['doc']
        if field['type'] == 'choice':
            doc = ', '.join(code(word) for word in field['words']) + (f'; {doc}' if doc else '')
        doc = plain(doc) + (f'; with {code(field["with"])}' if field['with'] else '')
        rows.append([code(field['name']), field['type'], unit(field['unit']), doc])
    return table('Fields of its state' if kind['role'] == 'device' else 'Fields of its reading',
                 ['field', 'type', 'unit', ''], rows)


def host(kind: Kind, catalog: dict[str, Kind]) -> Kind | None:
    """The device of a sensor in its library, whose <plugin> element makes both."""
    if kind['role'] == 'device':
        return None
    hosts = [other for other in catalog.values()
             if other['library'] == kind['library'] and other['role'] == 'device']
    return hosts[0] if hosts else None


def discovery(kind: Kind) -> str:
    """The messages by which angen mqtt shows a thing of the kind to Home Assistant."""
    if not is_shown(kind, truth=True):
        return ''
    thing = Thing(kind['kind'], 'kitchen0', 'kitchen0', '', 'Kitchen',
                  components(kind, 'kitchen0', range(2), FINITE))
    thing.label = f'Kitchen {noun(thing).lower()}'
    made = Discovery(Plain('angen'), False, ANY).messages(thing)
    text = ''.join(f'`{topic}`\n\n```json\n{wrapped(payload)}\n```\n\n'
                   for topic, payload in made.items())
    return f'\n## On MQTT\n\nOf one in the kitchen, by `angen mqtt`:\n\n{text}'.rstrip() + '\n' \
        if made else ''


def wrapped(payload: str) -> str:
    return textwrap.fill(json.dumps(json.loads(payload), ensure_ascii=False), 118,
                         subsequent_indent=' ', break_long_words=False, break_on_hyphens=False)


def page(kind: Kind, catalog: dict[str, Kind], described_in: str) -> str:
    name, shared = kind['kind'], host(kind, catalog)
    text = f'# {name}\n\n{NOTE}{plain(kind["doc"])} Library: `{kind["library"]}`.'
    text += f' Described in [{described_in}](../{described_in}).\n' if described_in else '\n'
    beside = set()
    if shared:
        beside = {param['path'] for param in shared['params']}
        text += (f'\nIt shares its `<plugin>` element with [{shared["kind"]}]({shared["kind"]}.md),'
                 ' whose parameters it has too.\n')
    if any('/' in param['path'] for param in kind['params']):
        text += ('\nA parameter with a path, such as `a/b`, is an element `<a><b>` of `<sensor>`;'
                 ' the others are elements of `<plugin>`.\n')
    return text + parameters(kind, beside) + commands(kind) + fields(kind) + discovery(kind)


def index(catalog: dict[str, Kind]) -> str:
    text = ('# Reference: parameters, commands and fields of each kind\n\n' + NOTE
            + '```\n./angen plugins\n```\n\nprints the same in a terminal.\n')
    for role in ('device', 'sensor'):
        text += f'\n## {role.capitalize()}s\n\n' + ''.join(
            f'- [{name}]({name}.md): {plain(kind["doc"])}\n'
            for name, kind in sorted(catalog.items()) if kind['role'] == role)
    return text


def described_in() -> dict[str, str]:
    """The first page that links to a kind's reference; its own page before a list of many."""
    found: dict[str, str] = {}
    pages = [page for page in DOCS.rglob('*.md') if page.parent != REFERENCE]
    for path in sorted(pages, key=lambda page: (page.parent == DOCS, page)):
        for kind in re.findall(r'\((?:\.\./)?reference/(\w+)\.md', path.read_text()):
            found.setdefault(kind, path.relative_to(DOCS).as_posix())
    return found


def listed(folder: str) -> str:
    """Links to the pages of a folder, by title."""
    links = []
    for path in sorted((DOCS / folder).glob('*.md')):
        title = path.read_text().partition('\n')[0].removeprefix('# ')
        if not title[:2].isupper():
            title = title[0].lower() + title[1:]
        links.append(f'[{title}](docs/{folder}/{path.name})')
    return f'{folder.capitalize()}: ' + ', '.join(sorted(links, key=str.lower)) + '.'


def readme() -> str:
    """README.md with the paragraphs that list the pages of devices and sensors."""
    text = README.read_text()
    for folder in ('devices', 'sensors'):
        paragraph = textwrap.fill(listed(folder), 120, break_on_hyphens=False)
        text = re.sub(rf'^{folder.capitalize()}: \[.*?\.\n\n', lambda _: paragraph + '\n\n', text,
                      count=1, flags=re.MULTILINE | re.DOTALL)
    return text


def pages(catalog: dict[str, Kind]) -> dict[Path, str]:
    """README.md and all files of docs/reference/ with their text."""
    where = described_in()
    made = {REFERENCE / f'{name}.md': page(kind, catalog, where.get(name, ''))
            for name, kind in catalog.items()}
    return {README: readme(), REFERENCE / 'README.md': index(catalog), **made}


def written() -> set[Path]:
    return {path for path in REFERENCE.glob('*.md') if NOTE in path.read_text()}


def main() -> int:
    parser = argparse.ArgumentParser(description='Writes docs/reference/ from the catalog.')
    parser.add_argument('--check', action='store_true', help='only name the pages that differ')
    check = parser.parse_args().check
    made = pages(read_catalog())
    changed = [path for path in {*made, *written()}
               if not path.exists() or path.read_text() != made.get(path)]
    for path in sorted(changed):
        print(path.relative_to(DOCS.parent))
        if not check and path in made:
            REFERENCE.mkdir(exist_ok=True)
            path.write_text(made[path])
        elif not check:
            path.unlink()
    return int(check and bool(changed))


if __name__ == '__main__':
    sys.exit(main())
