"""angen web: starts the server and prints its address."""
from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import signal
import socket
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Sequence

from angen_apps.plan.symbols import SYMBOLS
from angen_apps.web.guard import BUILD, LOOK, SWITCH, Guard, is_loopback, url_host
from angen_apps.web.server import Server, Site, Source, listen
from angen_tools.common.catalog import kinds
from angen_tools.common.installed import share
from angen_tools.common.port import not_served, require_free

if TYPE_CHECKING:
    from angen_apps.web.film import Film
    from angen_apps.web.played import Lined

ROLES = {SWITCH: 'to switch, not to build', LOOK: 'to look only'}  # what further addresses are for
KEYS = ('kind', 'doc', 'role', 'verbs', 'values', 'fields', 'models')  # keys that the page reads


def page() -> Path:
    """The folder of the page's files."""
    return share('angen_apps') / 'page'


def described_kinds() -> dict[str, Any]:
    """The descriptions of the kinds."""
    return {name: {key: kind[key] for key in KEYS} for name, kind in kinds().items()}


def own_address() -> str:
    """This machine's address in its network; nothing is sent to find it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        with contextlib.suppress(OSError):
            probe.connect(('192.0.2.1', 9))
            return str(probe.getsockname()[0])
    return '127.0.0.1'


def show_address(url: str, with_code: bool, as_json: bool, command: str = 'web',
                 others: dict[str, str] | None = None) -> None:
    """`others`: addresses that may do less, by their role."""
    others = others or {}
    print(json.dumps({'address': url, **others}) if as_json else f'angen {command}: {url}',
          flush=True)
    if not as_json:
        for role, address in others.items():
            print(f'angen {command}: {ROLES[role]}: {address}', flush=True)
    if with_code and not as_json:
        import qrcode
        code = qrcode.QRCode()
        code.add_data(url)
        code.print_ascii(out=sys.stdout, tty=sys.stdout.isatty(), invert=True)
        sys.stdout.flush()


async def _serve(command: str, site: Callable[[Guard], Site], host: str, port: int, as_json: bool,
                 roles: Sequence[str]) -> None:
    anywhere = host in ('0.0.0.0', '::')
    shown = own_address() if anywhere else host
    guard = Guard(host, port, {shown, socket.gethostname()}, roles)

    async def started(_: int) -> None:
        address = f'http://{url_host(shown)}:{port}/'
        links = {role: f'{address}?token={token}' for role, token in guard.tokens.items()}
        show_address(links.pop(BUILD, address), bool(guard.tokens), as_json, command, links)

    work = asyncio.ensure_future(listen(site(guard), host, port, started))
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, work.cancel)
    with contextlib.suppress(asyncio.CancelledError):
        try:
            await work
        except OSError as error:
            raise not_served(host, port, error) from None


def serve(command: str, site: Callable[[Guard], Site], host: str, port: int, as_json: bool,
          roles: Sequence[str] = (BUILD,)) -> None:
    """Serves a site until Ctrl-C; `command` is that of angen. Each of the roles has an address."""
    logging.basicConfig(level=logging.WARNING, format='%(message)s')
    if not is_loopback(host):
        print(f'angen {command}: reachable from other machines; anyone with the address and its '
              'token controls the building, and nothing is encrypted', file=sys.stderr)
    asyncio.run(_serve(command, site, host, port, as_json, roles))


def symbols() -> dict[str, Any]:
    """The lines of the symbols of furniture."""
    return {name: [[[round(x, 3), round(y, 3)] for x, y in line] for line in lines]
            for name, lines in SYMBOLS.items()}


def _serve_source(source: Source, host: str, port: int, as_json: bool) -> None:
    def site(guard: Guard) -> Site:
        return Server(source, guard, page(), described_kinds())

    source.store.put('symbols', symbols())
    serve('web', site, host, port, as_json, (BUILD, *ROLES))


def _recording(path: Path, world: Path | None) -> Lined:
    """A recorded run, or a folder of angen generate."""
    if path.is_dir():
        from angen_apps.web.day import Day
        return Day(path, world)
    from angen_apps.web.recording import Recording
    return Recording(path)


def web_recording(path: Path, world: Path | None, host: str, port: int,
                  as_json: bool) -> None:
    """A page that plays a recording."""
    require_free(host, port)
    with _recording(path, world) as played:
        _serve_source(played, host, port, as_json)


def web_video(film: Film, path: Path | None, world: Path | None) -> None:
    """A video of a recording, or without one of the running building from now on."""
    from angen_apps.web.film import shoot
    film.check()
    source: Lined
    if path is None:
        from angen_apps.web.captured import Captured
        source = Captured(film.seconds * (film.speed or 1.0))
    else:
        source = _recording(path, world)
    with source:
        source.store.put('symbols', symbols())
        shoot(source, film, page(), described_kinds())


def web_live(host: str, port: int, as_json: bool) -> None:
    """A running node, or the one that will run."""
    from angen_apps.web.feed import Feed
    from angen_apps.web.node import start_node
    require_free(host, port)
    start_node('web')
    _serve_source(Feed(), host, port, as_json)
