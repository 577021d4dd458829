"""angen plugins: the catalog of plug-ins, without a simulator."""
from __future__ import annotations

from typing import TYPE_CHECKING

from angen_tools.common.catalog import plugins
from angen_tools.common.output import as_json, table

if TYPE_CHECKING:
    from rich.console import RenderableType


def list_plugins(json: bool) -> RenderableType:
    """Every plug-in on the path with its parameters."""
    from rich.console import Group
    if json:
        return as_json(plugins())
    parts: list[RenderableType] = []
    for plugin in plugins():
        parts += [''] if parts else []
        parts.append(f'{plugin["kind"]}  {plugin["library"]}  {plugin["doc"]}')
        parts.append(table(('  PARAMETER', 'DEFAULT', 'UNIT', 'TYPE', 'MEANING'),
                           [('  ' + p['path'], p['default'], p['unit'], p['type'], p['doc'])
                            for p in plugin['params']]))
    return Group(*parts)
