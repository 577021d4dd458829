#!/usr/bin/env python3
"""Writes the tables of parameters, commands and fields into the pages of docs/.

    python3 docs/tables.py            writes them, names the pages that changed
    python3 docs/tables.py --check    writes nothing, ends with 1 where a page differs

What stands between `<!-- table KIND parameters -->` (or commands, fields) and `<!-- end -->` comes
from the catalog files beside the plug-in libraries, which the build makes of the plug-ins' own
descriptions. `<!-- table pir parameters model pyroelectric -->` has the parameters that exist only
with that value of another one, `<!-- table odometry parameters beside diff_drive -->` those that
diff_drive, of the same <plugin>, has not.
"""
from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path
from typing import Any

DOCS = Path(__file__).resolve().parent
CATALOG = DOCS.parent / 'devel/lib'
TABLE = re.compile(r'(<!-- table (\w+) (\w+)(?: (\w+ \w+))? -->\n).*?(<!-- end -->)', re.DOTALL)
WITH = re.compile(r'with (\w+ \w+): (.*)')

Kind = dict[str, Any]


def read_catalog(folder: Path = CATALOG) -> dict[str, Kind]:
    files = sorted(folder.glob('*.json'))
    kinds = [kind for file in files for kind in json.loads(file.read_text())]
    if not kinds:
        raise SystemExit(f'docs/tables.py: no catalog in {folder}; run ./angen build first')
    return {kind['kind']: kind for kind in kinds}


def unit(text: str) -> str:
    return text.replace('^2', '²').replace('^3', '³').replace('degC', '°C')


def number(text: str) -> str:
    """At most five digits, as 3.1241 for 3.12413936106985."""
    try:
        return f'{float(text):.5g}' if len(text) > 7 else text
    except ValueError:
        return text


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ['---'] * len(head), *rows]
    return ''.join('| ' + ' | '.join(cells) + ' |\n' for cells in lines)


def code(text: str) -> str:
    return f'`{text}`' if text else ''


def parameters(kind: Kind, variant: str | None, beside: set[str]) -> str:
    rows = []
    for param in kind['params']:
        if param['path'] in beside:
            continue
        special = WITH.fullmatch(param['doc'])
        if (special and special.group(1)) != variant:
            continue
        name, doc = param['path'], special.group(2) if special else param['doc']
        if param['choices']:
            doc += ': ' + ', '.join(code(choice) for choice in param['choices'])
        elif 'any number of times' in param['type']:
            doc += ' (' + param['type'] + ')'
        rows.append([code(name), number(param['default']), unit(param['unit']), doc])
    return table(['parameter', 'default', 'unit', ''], rows)


def limits(verb: dict[str, Any]) -> str:
    if not verb['argument']:
        return ''
    least, most = verb['min'], verb['max']
    span = '' if least is None or most is None else f'{least:g} to {most:g}'
    return (span + ' ' + unit(verb['unit'])).strip()


def commands(kind: Kind, _: str | None, __: set[str]) -> str:
    rows = [[code(verb['name'] + (f' {verb["argument"].upper()}' if verb['argument'] else '')),
             limits(verb), verb['doc']] for verb in kind['verbs']]
    return table(['command', 'range', ''], rows)


def fields(kind: Kind, _: str | None, __: set[str]) -> str:
    rows = []
    for field in kind['fields']:
        doc = field['doc']
        if field['type'] == 'choice':
            doc = ', '.join(code(word) for word in field['words']) + (f'; {doc}' if doc else '')
        rows.append([code(field['name']), field['type'], unit(field['unit']), doc])
    return table(['field', 'type', 'unit', ''], rows)


def with_tables(page: str, catalog: dict[str, Kind]) -> str:
    """The page with its tables as the catalog has them."""
    makers = {'parameters': parameters, 'commands': commands, 'fields': fields}

    def make(match: re.Match[str]) -> str:
        begin, kind, what, variant, end = match.groups()
        if kind not in catalog or what not in makers:
            raise SystemExit(f'docs/tables.py: {begin.strip()}: no such kind or table; kinds are '
                             + ', '.join(sorted(catalog)) + '; tables ' + ', '.join(makers))
        beside: set[str] = set()
        if variant is not None and variant.startswith('beside '):
            beside = {param['path'] for param in catalog[variant.split()[1]]['params']}
            variant = None
        return begin + makers[what](catalog[kind], variant, beside) + end

    return TABLE.sub(make, page)


def main() -> int:
    parser = argparse.ArgumentParser(description='Writes the tables of docs/ from the catalog.')
    parser.add_argument('--check', action='store_true', help='only name the pages that differ')
    check = parser.parse_args().check
    catalog, changed = read_catalog(), []
    for page in sorted(DOCS.rglob('*.md')):
        text = page.read_text()
        made = with_tables(text, catalog)
        if made != text:
            changed.append(page)
            if not check:
                page.write_text(made)
    for page in changed:
        print(page.relative_to(DOCS.parent))
    return int(check and bool(changed))


if __name__ == '__main__':
    sys.exit(main())
