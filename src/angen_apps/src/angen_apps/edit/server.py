"""The server of angen edit: gives the page a home, and checks, keeps, writes and simulates it."""
import asyncio
import json
from contextlib import suppress
from pathlib import Path
from typing import Any

from aiohttp import WSMsgType, web

from angen_apps.data.shapes import check_shape
from angen_apps.edit.desk import LARGEST, Conflict, Desk
from angen_apps.edit.limits import ORDER
from angen_apps.edit.simulation import Simulation
from angen_apps.web.guard import Guard
from angen_apps.web.server import Site, json_text
from angen_apps.web.threads import in_thread
from angen_tools.common.failure import Failure

MOST_WINDOWS = 20
PULSE = 20.0  # s between pings


class Editor(Site):
    """`given`: what each page gets once, such as the catalog; `behind`: a picture of the plan."""

    def __init__(self, desk: Desk, simulation: Simulation, given: dict[str, Any], guard: Guard,
                 page: Path, behind: Path | None = None) -> None:
        super().__init__(guard, page, 'edit.html', LARGEST)
        self._desk, self._simulation, self._given = desk, simulation, given
        self._windows: set[web.WebSocketResponse] = set()
        self._turn = asyncio.Lock()  # one change at a time
        self._runs = asyncio.Lock()  # one simulation at a time
        self._prepares: asyncio.Task[None] | None = None
        self.app.add_routes([web.get('/home.json', self._home), web.get('/windows', self._window),
                             web.get('/plan.svg', self._picture),
                             web.post('/do/{what}', self._do)])
        if behind is not None:
            picture = behind

            async def send(_: web.Request) -> web.FileResponse:
                return web.FileResponse(picture)

            self.app.add_routes([web.get('/behind', send)])
        self.app.on_shutdown.append(self._stop)

    async def _stop(self, _: web.Application) -> None:
        for window in list(self._windows):
            await window.close(code=1001, message=b'the server ends')
        await in_thread(self._simulation.close)

    async def _home(self, _: web.Request) -> web.Response:
        opened = await in_thread(self._desk.opened)
        return _json({**self._given, **opened})

    async def _picture(self, _: web.Request) -> web.Response:
        try:
            drawn = await in_thread(self._desk.picture)
        except Failure as failure:
            raise web.HTTPNotFound(text=f'{failure}\n') from None
        return web.Response(body=drawn, content_type='image/svg+xml')

    async def _window(self, request: web.Request) -> web.StreamResponse:
        """Tells a page how many windows have the home open."""
        if request.headers.get('Origin') is None:  # each browser sends it
            raise web.HTTPForbidden(text='A WebSocket needs an Origin.\n')
        if len(self._windows) >= MOST_WINDOWS:
            raise web.HTTPServiceUnavailable(text='Too many pages are open.\n')
        window = web.WebSocketResponse(heartbeat=PULSE, max_msg_size=1024)
        await window.prepare(request)
        self._windows.add(window)
        try:
            await self._tell()
            async for message in window:
                if message.type != WSMsgType.TEXT:
                    break
        finally:
            self._windows.discard(window)
            await self._tell()
        return window

    async def _tell(self) -> None:
        for window in list(self._windows):
            try:
                await window.send_str(json_text({'windows': len(self._windows)}))
            except (ConnectionError, RuntimeError):  # it went away in the meantime
                self._windows.discard(window)

    async def _do(self, request: web.Request) -> web.Response:
        """Executes what a page asks for."""
        if request.headers.get('Origin') is None:  # each browser sends it
            raise web.HTTPForbidden(text='An order needs an Origin.\n')
        try:
            order = json.loads(await request.read())
            if not isinstance(order, dict):
                raise ValueError
        except (ValueError, RecursionError):
            return _json({'text': 'not a JSON object'}, 400)
        try:
            return _json(await self._execute(request.match_info['what'], order))
        except Conflict as conflict:
            return _json({'text': str(conflict), 'version': self._desk.version}, 409)
        except Failure as failure:
            return _json({'text': str(failure)}, 422)

    async def _prepare(self) -> None:
        """Starts what the first simulation would have to wait for; that one reports failures."""
        async with self._runs:
            with suppress(Failure, OSError):
                await in_thread(self._simulation.prepare)

    async def _execute(self, what: str, order: dict[str, Any]) -> dict[str, Any]:
        check_shape('the order', order, ORDER)
        desk, drawing, base = self._desk, order.get('drawing'), order.get('base')
        if what == 'survey':
            if self._prepares is None:  # somebody draws
                self._prepares = asyncio.create_task(self._prepare())
            found: dict[str, Any] = await in_thread(desk.survey, drawing, order.get('floor'))
            return found
        async with self._turn:
            text = ''
            if what == 'keep':
                await in_thread(desk.keep, drawing, order.get('at', 0), base)
            elif what == 'discard':
                await in_thread(desk.discard, base)
            elif what in ('save', 'simulate', 'day'):
                text = await in_thread(desk.save, drawing, base, order.get('anyway') is True)
            else:
                raise Failure(f'{what} is not known; there are survey, keep, discard, save, '
                              'simulate and day')
            answer = {'version': desk.version, 'text': text}
        if what in ('simulate', 'day'):
            async with self._runs:
                run = self._simulation.run if what == 'simulate' else self._simulation.day
                try:
                    household = await in_thread(desk.household, drawing)
                    answer['address'] = await in_thread(run, desk.path, household)
                except Failure as failure:  # it is saved
                    answer['wrong'] = str(failure)
        return answer


def _json(data: Any, status: int = 200) -> web.Response:
    return web.Response(text=json_text(data), content_type='application/json', status=status)
