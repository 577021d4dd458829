"""The HTTP and WebSocket server of angen web."""
import asyncio
import gzip
import json
import logging
from math import isfinite
from pathlib import Path
from typing import Any, Awaitable, Callable, Protocol

from aiohttp import WSMsgType, web
from aiohttp.http_exceptions import HttpProcessingError

from angen_apps.web.files import Files
from angen_apps.web.guard import BUILD, HEADERS, ROLE, Budget, Guard, Handler, refusal
from angen_apps.web.history import numbers
from angen_apps.web.store import Store
from angen_apps.web.threads import in_thread
from angen_tools.common.output import with_each

MOST_BROWSERS, RESERVED = 40, 5  # the last ones are of the role that may do all
LARGEST_MESSAGE = 16 * 1024  # bytes, of a browser
RATE, BURST = 40.0, 80.0  # messages per second of a browser
MOST_PENDING = 20  # orders of a browser
PERIOD = 0.05  # s between updates of a browser
MOST_ANSWERS = 1000  # waiting for a browser, or to messages that are no orders
HEADERS_LIMIT = 10.0  # s in which a connection has sent its first request
PULSE = 60.0  # s between pings, which notice a browser that went away; one may draw for half of it
COST = 'cost'
PACKED = {'Content-Encoding': 'gzip'}
log = logging.getLogger('angen.web')


class Source(Protocol):
    """The source of the pages: a running node or a recording."""

    store: Store

    async def serve(self) -> None:
        """Fills the store while `request` says that there are browsers; until cancelled."""

    def request(self, topics: set[str] | None) -> None:
        """Topics beyond the usual ones that some browser shows; None: there is no browser."""

    async def order(self, order: dict[str, Any]) -> dict[str, Any]:
        """Executes an order of a browser, which gets the answer; ValueError rejects it."""

    def close(self) -> None:
        """Ends threads."""


class Browser:
    """One page that is open."""

    def __init__(self, socket: web.WebSocketResponse, access: dict[str, Any]) -> None:
        """`access`: what it is told of its role."""
        self.socket = socket
        self.role: str = access['role']
        self._access: dict[str, Any] | None = access
        self.requested: set[str] = set()
        self.pending = 0  # orders without an answer
        self.errors = 0  # messages that are no orders
        self.news = asyncio.Event()
        self.news.set()
        self.answers: list[dict[str, Any]] = []

    def answer(self, answer: dict[str, Any]) -> None:
        self.answers.append(answer)
        self.news.set()

    @property
    def is_broken(self) -> bool:
        """Whether it reads no answers, or sends what no page sends."""
        return max(len(self.answers), self.errors) > MOST_ANSWERS

    async def feed(self, store: Store) -> None:
        """Sends what changed, as fast as the browser takes it."""
        seen = 0
        while not self.socket.closed:
            await self.news.wait()
            self.news.clear()
            update = store.since(seen, self.requested, () if COST in self.requested else (COST,))
            seen = update.version
            if update.more:
                self.news.set()
            if self._access:
                update.parts['access'], self._access = self._access, None
            if self.answers:
                update.parts['answers'], self.answers = self.answers, []
            if update.parts:
                await self.socket.send_str(json_text(update.parts))
            for blob in update.blobs:
                await self.socket.send_bytes(blob)
            if update:
                await asyncio.sleep(PERIOD)


def is_of_server(record: logging.LogRecord) -> bool:
    """False for requests that are no HTTP, which their clients are told, and for clients that went
    away."""
    error = record.exc_info[1] if record.exc_info else None
    return not isinstance(error, (HttpProcessingError, ConnectionResetError, BrokenPipeError))


class Site:
    """The application with its files: those of the folder `page`, of which `index` is the first."""

    def __init__(self, guard: Guard, page: Path, index: str, largest: int) -> None:
        """`largest`: bytes of a request."""
        logging.getLogger('aiohttp.server').addFilter(is_of_server)
        self._files, self._name = Files(page), index
        self.clients: set[Any] = set()  # protocols of connections that sent a request
        self.app = web.Application(middlewares=[self._count_client, guard.middleware],
                                   client_max_size=largest)
        self.app.add_routes([web.get('/', self._index),
                             web.get('/page/{name:.+}', self._files.get)])

    @web.middleware
    async def _count_client(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        self.clients.add(request.protocol)
        return await handler(request)

    async def _index(self, request: web.Request) -> web.StreamResponse:
        return await self._files.answer(request, self._name)


class Server(Site):
    """Serves a source."""

    def __init__(self, source: Source, guard: Guard, page: Path, kinds: dict[str, Any]) -> None:
        super().__init__(guard, page, 'index.html', LARGEST_MESSAGE)
        self._source, self._guard = source, guard
        self._fields = {name: numbers(kind) for name, kind in kinds.items()}
        self._exports = asyncio.Lock()
        self._kinds = gzip.compress(json_text(kinds).encode())
        self._browsers: set[Browser] = set()
        self._scene: tuple[int, bytes] = (0, b'')
        self._tasks: set[asyncio.Task[None]] = set()
        self.app.add_routes([web.get('/socket', self._socket),
                             web.get('/scene.json', self._get_scene),
                             web.get('/kinds.json', self._get_kinds),
                             web.get('/history.json', self._get_history),
                             web.get('/readings.csv', self._get_readings)])
        self.app.on_startup.append(self._start)
        self.app.on_shutdown.append(self._stop)

    async def _start(self, _: web.Application) -> None:
        loop = asyncio.get_running_loop()

        def changed() -> None:
            if not loop.is_closed():
                loop.call_soon_threadsafe(self._notify)

        self._source.store.changed = changed
        self._keep(self._source.serve())

    async def _stop(self, _: web.Application) -> None:
        self._source.store.changed = lambda: None
        for browser in list(self._browsers):
            await browser.socket.close(code=1001, message=b'the server ends')
        for task in list(self._tasks):
            task.cancel()
        self._source.close()

    def _keep(self, work: Any) -> None:
        task = asyncio.ensure_future(work)
        self._tasks.add(task)
        task.add_done_callback(self._done)

    def _done(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and task.exception() is not None:
            log.error('angen web: %s', task.exception())

    def _notify(self) -> None:
        for browser in self._browsers:
            browser.news.set()

    def _request(self) -> None:
        topics = {topic for browser in self._browsers for topic in browser.requested}
        self._source.request(topics if self._browsers else None)

    async def _get_kinds(self, _: web.Request) -> web.Response:
        return web.Response(body=self._kinds, content_type='application/json', headers=PACKED)

    async def _get_scene(self, _: web.Request) -> web.Response:
        scene = self._source.store.scene
        if scene is None:
            raise web.HTTPNotFound(text='There is no scene yet.\n')
        if self._scene[0] != scene['number']:
            packed = await in_thread(pack, scene)
            self._scene = (scene['number'], packed)
        return web.Response(body=self._scene[1], content_type='application/json', headers=PACKED)

    async def _get_history(self, request: web.Request) -> web.Response:
        """The readings of a field in the whole run."""
        kind, name, field = (request.query.get(key, '') for key in ('kind', 'name', 'field'))
        names = [one['name'] for one in self._fields.get(kind, ())]
        if field not in names:
            raise web.HTTPNotFound(text='There is no such field.\n')
        times, values = self._source.store.history.of(kind, name, names.index(field))
        answer = web.json_response({'t': times, 'v': values}, dumps=json_text)
        answer.enable_compression()
        return answer

    async def _get_readings(self, request: web.Request) -> web.StreamResponse:
        """All readings of the run, as CSV."""
        answer = web.StreamResponse(headers={
            **HEADERS, 'Content-Type': 'text/csv; charset=utf-8',
            'Content-Disposition': 'attachment; filename=readings.csv'})
        answer.enable_compression()
        async with self._exports:  # one at a time: it costs some seconds of a large building
            await answer.prepare(request)
            for part in self._source.store.history.table(self._fields):
                await answer.write(part.encode())
            await answer.write_eof()
        return answer

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        if request.headers.get('Origin') is None:  # each browser sends it
            raise web.HTTPForbidden(text='A WebSocket needs an Origin.\n')
        role = request[ROLE]
        if len(self._browsers) >= MOST_BROWSERS - (0 if role == BUILD else RESERVED):
            raise web.HTTPServiceUnavailable(text='Too many pages are open.\n')
        socket = web.WebSocketResponse(heartbeat=PULSE, max_msg_size=LARGEST_MESSAGE)
        await socket.prepare(request)
        browser = Browser(socket, self._guard.access(role))
        self._browsers.add(browser)
        self._request()
        feeder = asyncio.ensure_future(self._feed(browser))
        try:
            await self._listen(browser)
        finally:
            feeder.cancel()
            self._browsers.discard(browser)
            self._request()
        return socket

    async def _feed(self, browser: Browser) -> None:
        try:
            await browser.feed(self._source.store)
        except (ConnectionError, RuntimeError):  # it disconnected in the meantime
            await browser.socket.close()

    async def _listen(self, browser: Browser) -> None:
        budget = Budget(RATE, BURST)
        async for message in browser.socket:
            if message.type != WSMsgType.TEXT or browser.is_broken:
                break
            try:
                order = json.loads(message.data)
            except (ValueError, RecursionError):
                order = None
            if not isinstance(order, dict) or not isinstance(order.get('id', 0), int):
                browser.errors += 1
                browser.answer({'id': 0, 'ok': False,
                                'text': 'not a JSON object whose id is an integer'})
            elif not budget.take():
                browser.answer({'id': order.get('id'), 'ok': False,
                                'text': f'more than {RATE:g} orders per second'})
            elif order.get('do') == 'subscribe' and isinstance(topics := order.get('topics'), list):
                browser.requested = requested(topics)
                self._request()
            elif why := refusal(browser.role, order.get('do')):
                browser.answer({'id': order.get('id'), 'ok': False, 'text': why})
            elif browser.pending >= MOST_PENDING:
                browser.answer({'id': order.get('id'), 'ok': False,
                                'text': 'the simulator has not answered earlier orders yet'})
            else:
                self._keep(self._execute(browser, order))

    async def _execute(self, browser: Browser, order: dict[str, Any]) -> None:
        browser.pending += 1
        answer: dict[str, Any]
        try:
            answer = {'ok': True, **await self._source.order(order)}
        except ValueError as error:
            answer = {'ok': False, 'text': str(error)}
        except Exception as error:  # an error of the server: the browser gets an answer
            log.error('angen web: %s: %r', order.get('do'), error)
            answer = {'ok': False, 'text': 'the server failed; its output says why'}
        finally:
            browser.pending -= 1
        browser.answer({'id': order.get('id'), **answer})


def requested(topics: list[Any]) -> set[str]:
    """At most eight names."""
    return {topic for topic in topics[:8] if isinstance(topic, str) and len(topic) < 300}


def json_text(data: Any) -> str:
    """JSON as browsers read it: a number that is not finite is null."""
    try:
        return json.dumps(data, separators=(',', ':'), allow_nan=False)
    except ValueError:
        return json.dumps(with_each(data, _finite), separators=(',', ':'), allow_nan=False)


def _finite(data: Any) -> Any:
    return None if isinstance(data, float) and not isfinite(data) else data


def pack(scene: dict[str, Any]) -> bytes:
    return gzip.compress(json_text(scene).encode(), 5)


async def close_idle(server: Site, runner: web.AppRunner) -> None:
    """Closes connections without a request in time, which would use up those of others."""
    began: dict[Any, float] = {}
    while True:
        await asyncio.sleep(HEADERS_LIMIT / 4)
        now = asyncio.get_running_loop().time()
        assert runner.server is not None
        server.clients.intersection_update(runner.server.connections)
        began = {protocol: began.get(protocol, now) for protocol in runner.server.connections
                 if protocol not in server.clients}
        for protocol, since in began.items():
            if now - since > HEADERS_LIMIT:
                protocol.force_close()


async def listen(server: Site, host: str, port: int,
                 started: Callable[[int], Awaitable[None]]) -> None:
    """Serves until cancelled; `started` gets the port."""
    runner = web.AppRunner(server.app, access_log=None, handle_signals=False)
    await runner.setup()
    try:
        site = web.TCPSite(runner, host, port, shutdown_timeout=1.0)
        await site.start()
        await started(port)
        await close_idle(server, runner)
    finally:
        await runner.cleanup()
