"""Hostile browsers on a running building: rejected messages are answered, the node continues."""
import asyncio
import json
import random
import socket
from pathlib import Path
from typing import Any

from aiohttp import ClientSession, ClientWebSocketResponse, WSMsgType
from angen_msgs.msg import DoorState
from angen_msgs.srv import List
from browser import LIMIT, Server
from harness import Angen, Inbox
from std_srvs.srv import Empty

BROWSERS, MESSAGES = 6, 60
LARGE = 16_000  # bytes, just below what a browser may send
VALUES = (None, True, -1, 0, 1e308, -1e308, 10 ** 300, '', 'x' * 4097, '\ud800', '\x00',
          '../../etc', '<img src=x onerror=alert(1)>', [], {}, [[[]]], {'x': 'y'},
          'On', 'Open', 0.01, 'all')
TARGETS = ('door/bathroom0', 'lamp/all', 'lamp/kitchen0', 'pir/eye', 'door/', '/', 'person/nobody')
KEYS = ('target', 'text', 'kind', 'name', 'rate', 'seconds', 'speed', 'turn', 'pose', 'x', 'yaw')
ORDERS = ('command', 'pause', 'resume', 'step', 'rate', 'spawn', 'delete', 'save', 'drive', 'goal',
          'reset', 'subscribe', 'eval', '__init__', '')


def order(rng: random.Random, number: int) -> tuple[str, int]:
    """A text, and the id of the answer that it must get."""
    made: dict[str, Any] = {key: rng.choice(VALUES) for key in KEYS if rng.random() < 0.6}
    made |= {'id': number, 'do': rng.choice(ORDERS)}
    if rng.random() < 0.5:
        made |= {'target': rng.choice(TARGETS), 'name': rng.choice(('turtlebot', 'eye', 'a', 'a')),
                 'kind': rng.choice(('pir', 'luminosity', 'door', 'none'))}
    if rng.random() < 0.3:
        made['pose'] = {key: rng.choice(VALUES) for key in ('x', 'y', 'z', 'yaw')}
    text = json.dumps(made)
    kind = rng.randrange(8)
    if kind == 0:
        return text[:rng.randrange(len(text))], 0
    if kind == 1:
        return '[' * rng.randrange(1, LARGE) + rng.choice(('', '1')), 0
    if kind == 2:
        return ''.join(chr(rng.randrange(1, 0xd800)) for _ in range(rng.randrange(1, 500))), 0
    if kind == 3:
        return json.dumps({'id': rng.choice([None, 'x', 1.5, [], {}]), 'do': 'pause'}), 0
    if kind == 4:
        return json.dumps(made | {'text': 'x' * (LARGE - len(text))}), number
    return text, number


async def attack(session: ClientSession, url: str, seed: int) -> list[str]:
    """Sends noise and reads all; the texts of rejections."""
    rng = random.Random(seed)
    browser = await connect(session, url)
    due, rejections, mistakes = set(), [], 0
    for number in range(1, MESSAGES + 1):
        text, answered = order(rng, number)
        await browser.send_str(text)
        mistakes += answered == 0
        if answered:
            due.add(answered)
    while due or mistakes:
        message = await browser.receive(timeout=LIMIT)
        assert message.type in (WSMsgType.TEXT, WSMsgType.BINARY), (message, due, mistakes)
        if message.type != WSMsgType.TEXT:
            continue
        for answer in json.loads(message.data).get('answers', []):
            mistakes -= answer['id'] == 0
            due.discard(answer['id'])
            if not answer['ok']:
                rejections.append(answer['text'])
    await browser.close()
    return rejections


async def connect(session: ClientSession, url: str) -> ClientWebSocketResponse:
    return await session.ws_connect(f'{url}socket', headers={'Origin': url.rstrip('/')},
                                    max_msg_size=0)


async def sleeper(port: int) -> socket.socket:
    """A browser that opens the socket, requests everything, and never reads."""
    lazy = socket.create_connection(('127.0.0.1', port))
    lazy.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
    lazy.sendall((f'GET /socket HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n'
                  f'Connection: Upgrade\r\nOrigin: http://127.0.0.1:{port}\r\n'
                  'Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n'
                  '\r\n').encode())
    return lazy


async def all_at_once(server: Server) -> list[str]:
    lazy = [await sleeper(server.port) for _ in range(3)]
    try:
        async with ClientSession() as session:
            found = await asyncio.gather(*(attack(session, server.url, seed)
                                           for seed in range(BROWSERS)))
            large = await connect(session, server.url)
            await large.send_str('x' * (1 << 20))
            while (last := await large.receive(timeout=LIMIT)).type in (WSMsgType.TEXT,
                                                                        WSMsgType.BINARY):
                pass
            assert last.type == WSMsgType.CLOSE and last.data == 1009  # too big
    finally:
        for one in lazy:
            one.close()
    return [text for rejections in found for text in rejections]


async def open_the_door(server: Server) -> None:
    async with ClientSession() as session:
        browser = await connect(session, server.url)
        await browser.send_json({'do': 'command', 'id': 9, 'target': 'door/bathroom0',
                                 'text': 'Open'})
        while True:
            message = await browser.receive(timeout=LIMIT)
            if message.type != WSMsgType.TEXT:
                continue
            for answer in json.loads(message.data).get('answers', []):
                assert answer['id'] == 9 and answer['ok'], answer
                await browser.close()
                return


def test_noise_of_several_browsers_ends_neither_node_nor_server(angen: Angen, tmp_path: Path
                                                                ) -> None:
    with Server(angen.master, tmp_path) as server:
        rejections = asyncio.run(all_at_once(server))
        assert any('must be' in text for text in rejections)
        assert any('JSON' in text for text in rejections)
        assert not [text for text in rejections if 'server failed' in text], server.log()
        assert angen.process.poll() is None, angen.log()
        angen.call('/gazebo/reset_simulation', Empty)
        angen.call('/gazebo/unpause_physics', Empty)
        names = {entity.name for entity in angen.call('/angen/list', List, kind='').entities}
        assert {'bathroom0', 'kitchen0', 'turtlebot'} <= names
        with Inbox('/angen/door/bathroom0', DoorState) as states:
            asyncio.run(open_the_door(server))
            states.wait(lambda state: state.mode in (DoorState.OPENING, DoorState.OPEN),
                        'a door that opens', LIMIT)
