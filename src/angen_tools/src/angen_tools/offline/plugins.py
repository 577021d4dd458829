"""angen plugins: the catalog of plug-ins, without a simulator."""
import re
from typing import Any, Iterator, Sequence

from angen_tools.common.catalog import Plugin, kind_of, plugins
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import asked, nearest
from angen_tools.common.output import RenderableType, as_json, table
from angen_tools.common.verbs import described_forms


def list_plugins(names: Sequence[str], json: bool) -> RenderableType:
    """The kinds of these names, or of these libraries, on the plug-in path, or all: their verbs,
    the fields of their state or reading, parameters. Failure if a name is not known."""
    from rich.console import Group
    libraries = {plugin['library'] for plugin in plugins()}
    for name in names:
        if name.endswith('.so') and name not in libraries:
            stems = {_stem(library): library for library in libraries}
            raise Failure(f"there is no library '{name}'; "
                          + asked([stems[stem] for stem in nearest(_stem(name), stems)]))
        if name not in libraries:
            kind_of(name)
    found = [plugin for plugin in plugins()
             if not names or plugin['kind'] in names or plugin['library'] in names]
    if json:
        return as_json(found)
    parts: list[RenderableType] = []
    for plugin in found:
        parts += [''] if parts else []
        parts.append('  '.join(filter(None, (plugin['kind'] or '(does not load)', plugin['role'],
                                             plugin['library'], plugin['doc']))))
        parts += _tables(plugin)
    return Group(*parts)


def _stem(library: str) -> str:
    """pir of libpir_controller.so."""
    return re.sub(r'^lib|(_plugin|_controller)?\.so$', '', library)


def _tables(plugin: Plugin) -> Iterator[RenderableType]:
    """Verbs, fields and parameters, a table for each that exists."""
    if plugin['verbs'] or plugin['values']:
        yield table(('  COMMAND', 'MEANING'), [('  ' + form, doc)
                                               for form, doc in described_forms(plugin)])
    if plugin['fields']:
        yield table(('  FIELD', 'UNIT', 'TYPE', 'MEANING'),
                    [('  ' + f['name'], f['unit'], _type_of(f),
                      f['doc'] + (f'; with {f["with"]}' if f['with'] else ''))
                     for f in plugin['fields']])
    if plugin['params']:
        yield table(('  PARAMETER', 'DEFAULT', 'UNIT', 'TYPE', 'MEANING'),
                    [('  ' + p['path'], p['default'], p['unit'], p['type'], p['doc'])
                     for p in plugin['params']])


def _type_of(field: dict[str, Any]) -> str:
    """A field's type; of a choice its words."""
    return '|'.join(field['words']) if field['type'] == 'choice' else field['type']
