"""Measures the cost and the speed of the page of angen web: docs/web.md, Figures.

    python3 bench/web.py [--world FILE --door NAME] [--seconds 20] [--browser]

in ./angen shell. CPU times say more than times on a busy machine; the load is printed.
"""
import argparse
import asyncio
import json
import os
import statistics
import struct
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from aiohttp import ClientSession, ClientWebSocketResponse, WSMsgType

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'tests/ros'))
from browser import Page, Server  # noqa: E402
from harness import Master, end  # noqa: E402

TICKS = os.sysconf('SC_CLK_TCK')
POSES = 1


def cpu(pid: int) -> float:
    """s of CPU time of a process; 0 of one that has ended, as some of a browser do."""
    try:
        fields = Path(f'/proc/{pid}/stat').read_text().rsplit(')', 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return (int(fields[11]) + int(fields[12])) / TICKS


def children(pid: int) -> list[int]:
    """A process and all that it started."""
    found = [pid]
    for task in Path(f'/proc/{pid}/task').iterdir():
        found += [one for child in (task / 'children').read_text().split()
                  for one in children(int(child))]
    return found


class Sockets:
    """Web sockets that read all they get, as pages do."""

    def __init__(self, port: int) -> None:
        self.url = f'http://127.0.0.1:{port}'
        self.bytes = 0

    async def _read(self, socket: ClientWebSocketResponse) -> None:
        async for message in socket:
            self.bytes += len(message.data)

    async def hold(self, count: int, seconds: float, pids: dict[str, int]) -> dict[str, float]:
        """% of a core of each process with this many open pages."""
        async with ClientSession() as session:
            sockets = [await self.open(session) for _ in range(count)]
            readers = [asyncio.ensure_future(self._read(socket)) for socket in sockets]
            await asyncio.sleep(3.0 if count else 8.0)  # topics come and go
            self.bytes = 0
            before, began = {name: cpu(pid) for name, pid in pids.items()}, time.monotonic()
            await asyncio.sleep(seconds)
            passed = time.monotonic() - began
            used = {name: 100 * (cpu(pid) - before[name]) / passed for name, pid in pids.items()}
            for socket in sockets:
                await socket.close()
            await asyncio.gather(*readers)
            return used | {'kB/s each': self.bytes / 1000 / passed / max(1, count)}

    async def open(self, session: ClientSession) -> ClientWebSocketResponse:
        return await session.ws_connect(f'{self.url}/socket', headers={'Origin': self.url},
                                        max_msg_size=0)

    async def clicks(self, door: str, count: int, pages: int) -> list[float]:
        """ms from an order to the first pose of the door's leaf that differs, on the last page that
        gets it."""
        async with ClientSession() as session:
            sockets = [await self.open(session) for _ in range(pages)]
            times: list[float] = []
            await self._all_quiet(sockets)  # all parts have come
            async with session.get(f'{self.url}/scene.json') as answer:
                scene = await answer.json()
            leaves = {i for i, link in enumerate(scene['links'])
                      if link['moves'] and link['model'] == f'{door[:-1]}_door{door[-1]}'}
            for i in range(count):
                await self._all_quiet(sockets)
                began = time.monotonic()
                await sockets[0].send_str(json.dumps({
                    'do': 'command', 'id': i, 'target': f'door/{door}',
                    'text': 'Close' if i % 2 else 'Open'}))
                await asyncio.gather(*(moved(socket, leaves) for socket in sockets))
                times.append(1000 * (time.monotonic() - began))
            for socket in sockets:
                await socket.close()
            return times

    async def _all_quiet(self, sockets: list[ClientWebSocketResponse]) -> None:
        await asyncio.gather(*(self._quiet(socket, 3.0) for socket in sockets))

    async def _quiet(self, socket: ClientWebSocketResponse, seconds: float) -> None:
        end_at = time.monotonic() + seconds
        while (left := end_at - time.monotonic()) > 0:
            try:
                await socket.receive(timeout=left)
            except asyncio.TimeoutError:
                return


async def moved(socket: ClientWebSocketResponse, leaves: set[int]) -> None:
    """Returns when a page has got the pose of one of these links."""
    while not moves(await socket.receive(), leaves):
        pass


def moves(message: Any, leaves: set[int]) -> bool:
    """Whether a message has poses of some of these links."""
    if message.type != WSMsgType.BINARY:
        return False
    kind, _, count = struct.unpack_from('<III', message.data)
    return kind == POSES and bool(leaves & set(struct.unpack_from(f'<{count}I', message.data, 12)))


def show(url: str, folder: Path, seconds: float) -> None:
    """First view and frames in a browser without a GPU."""
    page = Page(folder, 1440, 900)
    try:
        programs = children(page.driver.service.process.pid)
        before, began = sum(map(cpu, programs)), time.monotonic()
        page.open(url)
        page.until('return angen.view.frames > 0 && angen.view.framed')
        shown = time.monotonic() - began
        used = sum(map(cpu, programs)) - before
        print(f'first view: {shown:.1f} s, {used:.1f} s of CPU time of the browser')
        programs = children(page.driver.service.process.pid)
        gpu = next(pid for pid in programs if b'gpu-process' in
                   Path(f'/proc/{pid}/cmdline').read_bytes())
        page.run('setInterval(() => { angen.view.dirty = true; }, 10)')
        frames, used = page.run('return angen.view.frames'), cpu(gpu)
        time.sleep(seconds)
        frames, used = page.run('return angen.view.frames') - frames, cpu(gpu) - used
        triangles = page.run('return angen.view.renderer.info.render.triangles')
        print(f'frames: {frames / seconds:.1f} per second, {1000 * used / max(1, frames):.0f} ms '
              f'of CPU time each, {triangles} triangles')
    finally:
        page.close()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--world', type=Path, default=ROOT / 'worlds/angen.world')
    parser.add_argument('--door', default='bathroom0')
    parser.add_argument('--seconds', type=float, default=20.0)
    parser.add_argument('--pages', type=int, nargs='*', default=[0, 1, 0, 20])
    parser.add_argument('--browser', action='store_true')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        master = Master(folder)
        node = master.node(args.world, folder / 'node.log')
        server = Server(master, folder)
        try:
            print('load', os.getloadavg())
            time.sleep(2.0)  # a server subscribes late, if it does
            state = master.api.getSystemState('/bench')[2]
            count = sum('angen_web' in str(nodes) for _, nodes in state[1])
            print('subscribed without a page:', count)
            sockets, pids = Sockets(server.port), {'node': node.pid, 'server': server.process.pid}
            for count in args.pages:
                used = asyncio.run(sockets.hold(count, args.seconds, pids))
                print(f'{count} pages:', ', '.join(f'{key} {value:.2f}' + (
                    ' %' if key in pids else '') for key, value in used.items()), flush=True)
            for count in sorted({1, max(args.pages)}):
                times = asyncio.run(sockets.clicks(args.door, 10, count))
                print(f'click to moving door on {count} pages: median '
                      f'{statistics.median(times):.0f} ms, longest {max(times):.0f} ms')
            if args.browser:
                show(server.url, folder, args.seconds)
            print('load', os.getloadavg())
        finally:
            server.end()
            end(node)
            end(master.process)


if __name__ == '__main__':
    main()
