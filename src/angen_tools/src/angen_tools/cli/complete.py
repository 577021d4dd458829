"""Completions that a shell offers after TAB; none if there is no simulator to query."""
import argparse
from typing import Any, Callable

from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure

LIMIT = 1.0  # s that a shell waits for the simulator


def completed_by(argument: argparse.Action, completer: Callable[..., list[str]]) -> None:
    """Has argcomplete offer what `completer` returns."""
    argument.completer = completer  # type: ignore[attr-defined]


def _entities() -> list[Any]:
    from angen_tools.session.live import Live
    try:
        found: list[Any] = Live(limit=LIMIT).entities()
    except Failure:
        return []
    return found


def names_of(*chosen: str) -> Callable[..., list[str]]:
    """Names in the running simulator, of these kinds."""
    return lambda **_: [e.name for e in _entities() if e.kind in chosen]


def names_of_devices(kind: str) -> Callable[..., list[str]]:
    """Names of the devices of a kind, and all."""
    def names(**_: Any) -> list[str]:
        found = names_of(kind)()
        return [*found, 'all'] if found else []
    return names


def names_to_watch(**_: Any) -> list[str]:
    """Names of the sensors and devices."""
    return [e.name for e in _entities() if e.kind != 'model']


def names_to_delete(**_: Any) -> list[str]:
    """Names of the models and sensors; a device is deleted with its model."""
    devices = kinds('device')
    return [e.name for e in _entities() if e.kind not in devices]


def kind_names(**_: Any) -> list[str]:
    """The kinds of the catalog and of the running simulator."""
    return sorted({'model', *kinds(), *(e.kind for e in _entities())})


def sources(prefix: str = '', **options: Any) -> list[str]:
    """model:// addresses on the model path, or files and folders."""
    from argcomplete.completers import FilesCompleter

    from angen_tools.world.models import addresses
    found = list(FilesCompleter()(prefix, **options))
    if 'model://'.startswith(prefix[:8]):
        found += addresses()
    return found
