"""The server with a source of the test's own: access, files, orders."""
import asyncio
import json
import random
from pathlib import Path
from types import MappingProxyType, SimpleNamespace
from typing import Any, Awaitable, Callable

import pytest
from aiohttp import ClientSession, WSMsgType, WSServerHandshakeError, web
from angen_apps.web import guard, server as server_module
from angen_apps.web.guard import BUILD, LOOK, MAY, SWITCH, Guard, is_loopback
from angen_apps.web.orders import Orders
from angen_apps.web.server import BURST, LARGEST_MESSAGE, Browser, Server, json_text
from angen_apps.web.store import Store
from yarl import URL

PAGE = Path(__file__).resolve().parents[3] / 'src/angen_apps/page'


class Source:
    """A Source that records its calls."""

    def __init__(self) -> None:
        self.store = Store()
        self.orders: list[dict[str, Any]] = []
        self.requested: list[set[str] | None] = []

    async def serve(self) -> None:
        await asyncio.Event().wait()

    def request(self, topics: set[str] | None) -> None:
        self.requested.append(topics)

    async def order(self, order: dict[str, Any]) -> dict[str, Any]:
        self.orders.append(order)
        if order['do'] == 'bad':
            raise ValueError('rejected')
        if order['do'] == 'worse':
            raise KeyError('a mistake of the server')
        return {'text': 'done'}

    def close(self) -> None:
        pass


class Running:
    """A server on a free port."""

    def __init__(self, source: Source, guard: Guard, port: int, session: ClientSession) -> None:
        self.source, self.guard, self.session = source, guard, session
        self.host = f'127.0.0.1:{port}'

    async def get(self, path: str, **headers: str) -> tuple[int, str]:
        async with self.session.get(URL(f'http://{self.host}{path}', encoded=True), headers=headers,
                                    allow_redirects=False) as answer:
            return answer.status, await answer.text(errors='replace')

    def cookie(self, role: str) -> dict[str, str]:
        """The header of a browser that was given the role's link."""
        return {'Cookie': f'angen_token_{self.host.partition(":")[2]}={self.guard.tokens[role]}'}

    def socket(self, **headers: str) -> Any:
        return self.session.ws_connect(f'http://{self.host}/socket', max_msg_size=0,
                                       headers={'Origin': f'http://{self.host}', **headers})


def free_port() -> int:
    from socket import socket
    with socket() as free:
        free.bind(('127.0.0.1', 0))
        return int(free.getsockname()[1])


def run(test: Callable[[Running], Awaitable[None]], host: str = '127.0.0.1', page: Path = PAGE,
        kinds: Any = MappingProxyType({'lamp': {}})) -> None:
    async def go() -> None:
        port = free_port()
        source, guard = Source(), Guard(host, port, set(), (BUILD, SWITCH, LOOK))
        runner = web.AppRunner(Server(source, guard, page, dict(kinds)).app, access_log=None)
        await runner.setup()
        await web.TCPSite(runner, '127.0.0.1', port, shutdown_timeout=0.5).start()
        try:
            async with ClientSession() as session:
                await test(Running(source, guard, port, session))
        finally:
            await runner.cleanup()
    asyncio.run(asyncio.wait_for(go(), 120))


async def parts(socket: Any, key: str) -> Any:
    """The next message that has a part."""
    while True:
        message = await socket.receive(timeout=60)
        assert message.type in (WSMsgType.TEXT, WSMsgType.BINARY), message
        if message.type == WSMsgType.TEXT and key in (found := json.loads(message.data)):
            return found[key]


def test_it_serves_its_own_files_and_no_others() -> None:
    async def test(server: Running) -> None:
        status, text = await server.get('/')
        assert status == 200 and '/page/js/main.js' in text
        assert (await server.get('/page/js/main.js'))[0] == 200
        assert json.loads((await server.get('/kinds.json'))[1]) == {'lamp': {}}
        for path in ('/page/../../package.xml', '/page/%2e%2e/package.xml', '/page//etc/passwd',
                     '/page/js/..%2f..%2f..%2fpackage.xml', '/etc/passwd', '/page/'):
            assert (await server.get(path))[0] in (403, 404), path
    run(test)


def test_files_are_compressed_and_sent_once(tmp_path: Path) -> None:
    async def test(server: Running) -> None:
        total = 0
        for path in (*PAGE.rglob('*.js'), *PAGE.rglob('*.css'), PAGE / 'index.html'):
            url = f'http://{server.host}/page/{path.relative_to(PAGE)}'
            async with server.session.get(url) as answer:
                assert await answer.read() == path.read_bytes()
                total += int(answer.headers['Content-Length'])
                tag = answer.headers['ETag']
            async with server.session.get(url, headers={'If-None-Match': tag}) as answer:
                assert (answer.status, await answer.read()) == (304, b'')
        assert total < 400_000  # bytes: two seconds of a slow network

    run(test)
    page = tmp_path / 'page'
    page.mkdir()

    async def changed(server: Running) -> None:
        for content in ('one', 'another'):
            (page / 'a.js').write_text(content)
            assert (await server.get('/page/a.js'))[1] == content
    run(changed, page=page)


@pytest.mark.parametrize('host', ['evil.example', '127.0.0.1:1', 'localhost.evil.example:8080', ''])
def test_other_names_of_this_machine_are_rejected(host: str) -> None:
    async def test(server: Running) -> None:
        assert (await server.get('/', Host=host))[0] == 403
        assert (await server.get('/', Host=server.host.replace('127.0.0.1', 'LOCALHOST')))[0] == 200
    run(test)


@pytest.mark.parametrize('origin', ['http://evil.example', 'null', 'https://127.0.0.1', ''])
def test_pages_of_others_open_no_socket(origin: str) -> None:
    async def test(server: Running) -> None:
        with pytest.raises(WSServerHandshakeError) as rejected:
            await server.socket(Origin=origin)
        assert rejected.value.status == 403
        assert server.source.requested == []
    run(test)


def test_a_socket_without_an_origin_is_rejected() -> None:
    async def test(server: Running) -> None:
        assert (await server.get('/socket', Upgrade='websocket', Connection='Upgrade'))[0] == 403
    run(test)


def test_bytes_that_are_no_request_are_refused_and_not_logged(caplog: pytest.LogCaptureFixture
                                                              ) -> None:
    async def test(server: Running) -> None:
        host, _, port = server.host.partition(':')
        for sent, status in ((b'GET /?token=\xff HTTP/1.1\r\nHost: %s', b'401'),
                             (b'\xff / HTTP/1.1\r\nHost: %s', b'400'),
                             (b'GET / HTTP/1.1\r\nHost: %s\r\nHost: other', b'400')):
            reader, writer = await asyncio.open_connection(host, int(port))
            writer.write(sent.replace(b'%s', server.host.encode()) + b'\r\n\r\n')
            assert (await reader.readline()).split()[1] == status, sent
            writer.close()
    run(test, host='192.0.2.7')
    assert [record for record in caplog.records if record.name.startswith('aiohttp')] == []


def test_another_address_needs_its_token() -> None:
    async def test(server: Running) -> None:
        token = server.guard.tokens[BUILD]
        assert len(token) >= 32
        for path in ('/', '/?token=wrong', '/kinds.json', '/page/js/main.js', '/?token=',
                     '/?token=%C3%A9'):
            assert (await server.get(path))[0] == 401, path
        with pytest.raises(WSServerHandshakeError) as rejected:
            await server.socket()
        assert rejected.value.status == 401
        async with server.session.get(f'http://{server.host}/?t=1.5&token={token}',
                                      allow_redirects=False) as answer:
            assert answer.status == 302 and answer.headers['Location'] == '/?t=1.5'
            cookie = answer.headers['Set-Cookie']
            assert cookie.startswith(f'angen_token_{server.host.partition(":")[2]}=')
            assert answer.headers['Content-Security-Policy']
            assert 'HttpOnly' in cookie and 'SameSite=Strict' in cookie
        cookies = {'Cookie': cookie.split(';')[0]}
        assert (await server.get('/', **cookies))[0] == 200
        async with server.socket(**cookies) as socket:
            server.source.store.put('stats', 1)
            assert await parts(socket, 'stats') == 1
    run(test, host='192.0.2.7')


ORDERS = [*Orders(Store()).known(), 'nonsense', '', 5, None, ['command'], {'do': 'command'}]
OF_ROLES = {LOOK: [], SWITCH: ['command', 'drive', 'goal', 'halt'],
            BUILD: [order for order in ORDERS if order]}


@pytest.mark.parametrize('role', OF_ROLES)
def test_each_order_of_each_role_is_executed_or_refused(role: str) -> None:
    """By whoever has the token, also without the page."""
    async def test(server: Running) -> None:
        async with server.socket(**server.cookie(role)) as socket:
            access = await parts(socket, 'access')
            assert access['role'] == role
            assert access['tokens'] == (server.guard.tokens if role == BUILD
                                        else {role: server.guard.tokens[role]})
            for number, order in enumerate(ORDERS):
                for more in ({}, {'role': BUILD, 'token': 'x', 'access': {'role': BUILD}}):
                    await socket.send_str(json.dumps({'do': order, 'id': number, **more}))
                    answer, = await parts(socket, 'answers')
                    assert answer['id'] == number
                    may = role == BUILD or order in OF_ROLES[role]
                    assert answer['ok'] or not may or not order, answer
                    assert may or 'this link' in answer['text']
            await socket.send_str(json.dumps({'do': 'subscribe', 'topics': ['scan:a']}))
            while server.source.requested[-1] != {'scan:a'}:  # all may look
                await asyncio.sleep(0.01)
        executed = {str(order['do']) for order in server.source.orders}
        assert executed == ({str(order) for order in ORDERS} if role == BUILD
                            else set(OF_ROLES[role]))
    run(test, host='192.0.2.7')


def test_orders_of_roles_exist() -> None:
    assert set().union(*MAY.values()) <= set(Orders(Store()).known())


@pytest.mark.parametrize('method', ['POST', 'PUT', 'DELETE', 'PATCH'])
def test_no_request_changes_anything(method: str) -> None:
    async def test(server: Running) -> None:
        for path in ('/', '/socket', '/scene.json', '/kinds.json', '/page/js/main.js'):
            async with server.session.request(method, f'http://{server.host}{path}',
                                              headers=server.cookie(LOOK),
                                              data=b'{"do": "reset"}') as answer:
                assert answer.status == 405, path
        assert server.source.orders == []
    run(test, host='192.0.2.7')


def test_a_place_is_left_for_who_may_do_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_module, 'MOST_BROWSERS', 3)
    monkeypatch.setattr(server_module, 'RESERVED', 1)

    async def test(server: Running) -> None:
        cookie = server.cookie
        async with server.socket(**cookie(LOOK)), server.socket(**cookie(SWITCH)):
            with pytest.raises(WSServerHandshakeError) as rejected:
                await server.socket(**cookie(LOOK))
            assert rejected.value.status == 503
            async with server.socket(**cookie(BUILD)) as socket:
                assert (await parts(socket, 'access'))['role'] == BUILD
    run(test, host='192.0.2.7')


def test_loopback_addresses() -> None:
    assert [is_loopback(host) for host in (
        '127.0.0.1', '127.8.0.1', '::1', 'localhost', '0.0.0.0', '::', '192.168.0.2', 'example')
    ] == [True] * 4 + [False] * 4


def test_orders_are_answered() -> None:
    async def test(server: Running) -> None:
        async with server.socket() as socket:
            await socket.send_str(json.dumps({'do': 'command', 'id': 1}))
            assert await parts(socket, 'answers') == [{'id': 1, 'ok': True, 'text': 'done'}]
            await socket.send_str(json.dumps({'do': 'bad', 'id': 2}))
            assert await parts(socket, 'answers') == [{'id': 2, 'ok': False, 'text': 'rejected'}]
            await socket.send_str(json.dumps({'do': 'worse', 'id': 3}))
            answer, = await parts(socket, 'answers')
            assert (answer['id'], answer['ok']) == (3, False) and 'failed' in answer['text']
            for broken in ('{', '[]', '"x"', '[' * 9000, '{"do": "bad", "id": NaN}', '{"id": {}}'):
                await socket.send_str(broken)
                answer, = await parts(socket, 'answers')
                assert not answer['ok']
            assert [o['do'] for o in server.source.orders] == ['command', 'bad', 'worse']
    run(test)


def test_a_browser_that_floods_is_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guard, 'time', SimpleNamespace(monotonic=lambda: 5.0))  # none passes

    async def test(server: Running) -> None:
        async with server.socket() as socket:
            for i in range(400):
                await socket.send_str(json.dumps({'do': 'command', 'id': i}))
            answers = []
            while len(answers) < 400:
                answers += await parts(socket, 'answers')
            rejected = [answer for answer in answers if not answer['ok']]
            assert len(server.source.orders) == 400 - len(rejected) <= BURST
            assert all('per second' in answer['text'] or 'earlier' in answer['text']
                       for answer in rejected)
        async with server.socket() as socket:
            await socket.send_str('x' * (LARGEST_MESSAGE + 1))
            while (message := await socket.receive(timeout=60)).type != WSMsgType.CLOSE:
                pass
            assert message.data == 1009  # too big
    run(test)


def noise(rng: random.Random) -> str:
    """Messages that a hostile program could send."""
    value: Any = rng.choice([None, True, -1, 1e308, '', '\ud800', '\x00<img onerror=…>', [], {}])
    for _ in range(rng.randrange(4)):
        value = rng.choice([[value] * 3, {'do': value}, {'topics': value}, {'id': value}])
    do = rng.choice(['subscribe', 'command', 5, value])
    message = json.dumps({'do': do, 'id': 1, 'topics': value})
    cut = message[:rng.randrange(len(message) + 1)]
    return rng.choice([message, message, cut, cut + chr(rng.randrange(0x250)) * rng.randrange(200),
                       json.dumps(value)])


def test_noise_ends_no_server() -> None:
    rng = random.Random(29)

    async def test(server: Running) -> None:
        for _ in range(20):
            async with server.socket() as socket:
                for _ in range(50):
                    await socket.send_str(noise(rng))
                await socket.send_bytes(rng.randbytes(100))  # a page sends none: the server leaves
                while (await socket.receive(timeout=60)).type not in (WSMsgType.CLOSE,
                                                                      WSMsgType.CLOSED):
                    pass
        async with server.socket() as socket:
            await socket.send_str(json.dumps({'do': 'command', 'id': 4}))
            assert await parts(socket, 'answers') == [{'id': 4, 'ok': True, 'text': 'done'}]
    run(test)


def test_numbers_that_are_not_finite_are_null() -> None:
    assert json_text({'a': [1.5, float('nan')], 'b': {'c': -float('inf')}}) == \
        '{"a":[1.5,null],"b":{"c":null}}'


def test_a_browser_that_sends_no_orders_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_module, 'MOST_ANSWERS', 50)

    async def test(server: Running) -> None:
        async with server.socket() as socket:
            for _ in range(60):
                await socket.send_str('nonsense')
            for _ in range(200):
                if (await socket.receive(timeout=60)).type in (WSMsgType.CLOSE, WSMsgType.CLOSED):
                    return
        raise AssertionError('the socket is open')
    run(test)


def test_answers_that_a_browser_does_not_read_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_module, 'MOST_ANSWERS', 50)
    browser = Browser(web.WebSocketResponse(), {'role': BUILD})
    for i in range(50):
        browser.answer({'id': i})
        assert not browser.is_broken
    browser.answer({'id': 51})
    assert browser.is_broken


def test_a_connection_without_a_request_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_module, 'HEADERS_LIMIT', 0.4)

    async def go() -> None:
        ports: asyncio.Queue[int] = asyncio.Queue()
        guard = Guard('127.0.0.1', 0, set())
        serving = asyncio.ensure_future(server_module.listen(
            Server(Source(), guard, PAGE, {}), '127.0.0.1', free_port(), ports.put))
        port = await ports.get()
        idle, wrote = [await asyncio.open_connection('127.0.0.1', port) for _ in range(2)]
        wrote[1].write(b'GET / HTTP/1.1\r\n')  # and no more
        assert await asyncio.wait_for(idle[0].read(), 30) == b''
        assert await asyncio.wait_for(wrote[0].read(), 30) == b''
        async with ClientSession() as session:
            async with session.get(f'http://127.0.0.1:{port}/') as answer:
                assert answer.status == 403  # it has port 0, but it answers
                assert answer.headers['X-Content-Type-Options'] == 'nosniff'
        serving.cancel()
    asyncio.run(asyncio.wait_for(go(), 60))


def test_topics_are_requested_while_a_browser_shows_them() -> None:
    async def test(server: Running) -> None:
        requested = server.source.requested
        assert requested == []
        async with server.socket() as one:
            async with server.socket() as other:
                await one.send_str(json.dumps(
                    {'do': 'subscribe', 'topics': ['cost', 5, 'x' * 400]}))
                await other.send_str(json.dumps({'do': 'subscribe', 'topics': ['picture:a']}))
                while requested[-1] != {'cost', 'picture:a'}:
                    await asyncio.sleep(0.01)
            while requested[-1] != {'cost'}:
                await asyncio.sleep(0.01)
        while requested[-1] is not None:
            await asyncio.sleep(0.01)
    run(test)


def test_twenty_browsers_get_the_newest_state() -> None:
    async def test(server: Running) -> None:
        sockets = [await server.socket() for _ in range(20)]
        for i in range(200):
            server.source.store.put('stats', i)
        for socket in sockets:
            assert await parts(socket, 'stats') == 199  # what came between is not sent
            await socket.close()
    run(test)
