"""The server of angen edit: its orders, and who may give them."""
import asyncio
import json
from pathlib import Path
from typing import Any, Awaitable, Callable

import pytest
from aiohttp import ClientSession, web
from angen_apps.edit.desk import Desk
from angen_apps.edit.server import Editor
from angen_apps.edit.worker import Worker
from angen_apps.web.guard import Guard
from angen_tools.common.failure import Failure
from tests.angen_apps.edit.test_desk import drawn
from tests.angen_apps.web.test_server import PAGE, free_port


class Simulation:
    """One that fails, or serves."""

    def __init__(self) -> None:
        self.worlds: list[Path] = []
        self.prepared = 0
        self.closed = False

    def prepare(self) -> None:
        self.prepared += 1
        raise Failure('there is no port')

    def run(self, world: Path, household: dict[str, str]) -> str:
        self.worlds.append(world)
        assert household == {'kitchen': 'worker'}
        if len(self.worlds) == 1:
            raise Failure('the node ended')
        return 'http://127.0.0.1:1/'

    def day(self, world: Path, household: dict[str, str]) -> str:
        return f'http://127.0.0.1:2/{world.name}/{household["kitchen"]}'

    def close(self) -> None:
        self.closed = True


class Running:
    """An editor on a free port."""

    def __init__(self, desk: Desk, simulation: Simulation, session: ClientSession, port: int
                 ) -> None:
        self.desk, self.simulation, self._session = desk, simulation, session
        self.url = f'http://127.0.0.1:{port}'

    async def do(self, what: str, data: Any, **headers: str) -> tuple[int, Any]:
        body = data if isinstance(data, (str, bytes)) else json.dumps(data)
        async with self._session.post(f'{self.url}/do/{what}', data=body,
                                      headers={'Origin': self.url} | headers) as answer:
            text = await answer.text()
            return answer.status, json.loads(text) if text.startswith('{') else text

    async def get(self, path: str) -> tuple[int, str]:
        async with self._session.get(f'{self.url}{path}') as answer:
            return answer.status, await answer.text(errors='replace')

    def windows(self) -> Any:
        return self._session.ws_connect(f'{self.url}/windows', headers={'Origin': self.url})


def run(path: Path, test: Callable[[Running], Awaitable[None]], behind: Path | None = None
        ) -> None:
    worker = Worker()

    async def go() -> None:
        port = free_port()
        simulation: Any = Simulation()
        desk = Desk(path, worker)
        editor = Editor(desk, simulation, {'symbols': {}}, Guard('127.0.0.1', port, set()), PAGE,
                        behind)
        runner = web.AppRunner(editor.app)
        await runner.setup()
        await web.TCPSite(runner, '127.0.0.1', port, shutdown_timeout=0.5).start()
        try:
            async with ClientSession() as session:
                await test(Running(desk, simulation, session, port))
        finally:
            await runner.cleanup()
        assert simulation.closed

    try:
        asyncio.run(go())
    finally:
        worker.end()


def test_orders(tmp_path: Path) -> None:
    path = tmp_path / 'home.world'

    async def test(page: Running) -> None:
        status, text = await page.get('/home.json')
        assert status == 200 and json.loads(text)['version'] == 0
        assert (await page.get('/'))[0] == (await page.get('/page/js/edit.js'))[0] == 200
        status, found = await page.do('survey', {'drawing': drawn()})
        assert status == 200 and found['rooms'][0]['name'] == 'kitchen'
        assert await page.do('keep', {'drawing': drawn(), 'at': 1, 'base': 0}) == (
            200, {'version': 1, 'text': ''})
        status, said = await page.do('save', {'drawing': drawn(), 'base': 0})
        assert status == 409 and said['version'] == 1 and not path.exists()
        status, said = await page.do('save', {'drawing': drawn(), 'base': 1})
        assert status == 200 and path.exists()
        status, said = await page.do('simulate', {'drawing': drawn(), 'base': 2})
        assert status == 200 and said['wrong'] == 'the node ended' and said['version'] == 3
        status, said = await page.do('simulate', {'drawing': drawn(), 'base': 3})
        assert said['address'] == 'http://127.0.0.1:1/' and page.simulation.worlds == [path] * 2
        status, said = await page.do('day', {'drawing': drawn(), 'base': 4})
        assert said['address'] == 'http://127.0.0.1:2/home.world/worker' and said['version'] == 5
        status, picture = await page.get('/plan.svg')
        assert status == 200 and '<svg' in picture
        assert page.simulation.prepared == 1  # when somebody drew, and its failure was no end

    run(path, test)


def test_a_picture_is_behind_the_drawing(tmp_path: Path) -> None:
    async def test(page: Running) -> None:
        assert await page.get('/behind') == (200, 'a picture')

    async def without(page: Running) -> None:
        assert (await page.get('/behind'))[0] == 404

    (tmp_path / 'plan.png').write_text('a picture')
    run(tmp_path / 'home.world', test, tmp_path / 'plan.png')
    run(tmp_path / 'home.world', without)


@pytest.mark.parametrize('what, data, status, why', [
    ('survey', 'x', 400, 'not a JSON object'), ('survey', '[' * 10_000, 400, 'not a JSON object'),
    ('survey', b'\xff', 400, 'not a JSON object'), ('survey', '[]', 400, 'not a JSON object'),
    ('survey', {}, 422, 'must be {"plan"'), ('save', {'base': 0, 'drawing': 3}, 422, '"plan"'),
    ('keep', {'base': [], 'drawing': drawn()}, 409, 'another window'),
    ('spawn', {}, 422, 'spawn is not known'),
    *(('keep', {'base': 0, 'drawing': drawn(), 'at': at}, 422, 'the order: at is')
      for at in (10 ** 400, 1e300, -1, 'x', True, None)),
    ('survey', {'drawing': drawn(), 'floor': 10 ** 400}, 422, 'the order: floor is'),
    ('keep', f'{{"at": 1{5000 * "0"}}}', 400, 'not a JSON object'),
    ('keep', ' ' * (9 << 20), 413, '')])
def test_bad_orders_are_answered(tmp_path: Path, what: str, data: Any, status: int, why: str
                                 ) -> None:
    async def test(page: Running) -> None:
        code, said = await page.do(what, data)
        assert code == status and why in str(said)
        assert not list(tmp_path.iterdir())

    run(tmp_path / 'home.world', test)


def test_other_sites_may_not_change_a_home(tmp_path: Path) -> None:
    async def test(page: Running) -> None:
        order = {'drawing': drawn(), 'base': 0}
        assert (await page.do('save', order, Origin='http://evil.example'))[0] == 403
        assert (await page.do('save', order, Host='evil.example'))[0] == 403
        async with ClientSession() as session:
            async with session.post(f'{page.url}/do/save', data=json.dumps(order)) as answer:
                assert answer.status == 403
        assert not list(tmp_path.iterdir())

    run(tmp_path / 'home.world', test)


def test_windows_are_counted(tmp_path: Path) -> None:
    async def test(page: Running) -> None:
        async with page.windows() as first:
            assert await first.receive_json() == {'windows': 1}
            async with page.windows() as second:
                assert await first.receive_json() == await second.receive_json() == {'windows': 2}
            assert await first.receive_json() == {'windows': 1}

    run(tmp_path / 'home.world', test)
