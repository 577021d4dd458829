"""The catalog of plug-ins, as `import angen` knows it; no simulator needed."""
from __future__ import annotations

from functools import cache
from typing import Any

from angen_tools.common.failure import Failure


def angen_module() -> Any:
    """The module angen; Failure where it is not built or not on the path."""
    try:
        import angen
    except ImportError as error:
        raise Failure(f'the angen module is not found ({error}); use ./angen, or source '
                      'devel/setup.bash') from None
    return angen


@cache
def plugins() -> list[dict[str, Any]]:
    """Every plug-in: library, kind, doc, params (path, type, default, unit, doc)."""
    return angen_module().plugins()


def known_parameters(kind: str) -> dict[str, dict[str, Any]]:
    """The parameters of a kind of sensor, by key."""
    return {param['path']: param for plugin in plugins() if plugin['kind'] == kind
            for param in plugin['params']}
