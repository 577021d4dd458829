"""A simulator of the home that is drawn, on a master of its own, and its page."""
from __future__ import annotations

import json
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path
from subprocess import Popen

from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.port import free_port
from angen_tools.common.wait import wait
from angen_tools.live.sandbox import Sandbox, end

PROGRAM = 'from angen_tools.cli.main import main; main()'
RESIDENTS = 'from angen_apps.residents.node import main; main()'
STARTS = 7  # hour of the day
LIMIT = 60.0  # s until the page is served


class Simulation:
    """Starts at the first run; later ones have another node with the same page."""

    def __init__(self, host: str) -> None:
        self._host = host
        self._all = ExitStack()
        self._sandbox: Sandbox | None = None
        self._running: list[Popen[bytes]] = []  # the residents and the node
        self._page: Popen[bytes] | None = None

    def run(self, world: Path, household: dict[str, str]) -> str:
        """The address of the page of the world, which runs. `household`: profiles of residents, by
        the names of people in the world whose places they take."""
        if self._sandbox is None:
            folder = self._all.enter_context(tempfile.TemporaryDirectory(prefix='angen_edit_'))
            self._sandbox = self._all.enter_context(Sandbox(Path(folder)))
            self._page = self._sandbox.start([
                sys.executable, '-c', PROGRAM, 'web', '--host', self._host, '--port',
                str(free_port()), '--json'], 'web')
        while self._running:
            end(self._running.pop())
        self._running = [self._sandbox.node(world.absolute(), 1.0)]
        if household:
            self._running.append(self._settle(self._sandbox, world.absolute(), household))
        return self._address(self._sandbox.folder / 'web.log')

    @staticmethod
    def _settle(sandbox: Sandbox, world: Path, household: dict[str, str]) -> Popen[bytes]:
        """Residents instead of people who stand."""
        sandbox.start([sys.executable, '-c', PROGRAM, 'delete', *household], 'delete').wait(LIMIT)
        file = sandbox.folder / 'household.yaml'
        write_text(file, f'starts: {STARTS}\nresidents: {json.dumps(household)}\n')
        return sandbox.start([sys.executable, '-c', RESIDENTS, str(file), str(world)], 'residents')

    def _address(self, log: Path) -> str:
        def address() -> str:
            if self._page is not None and self._page.poll() is not None:
                raise Failure(f'angen web ended: {log.read_text(errors="replace").strip()}')
            lines = [line for line in log.read_text().splitlines() if line.startswith('{"address"')]
            return str(json.loads(lines[0])['address']) if lines and lines[0][-1] == '}' else ''

        wait(lambda: bool(address()), 'the page is not served', LIMIT)
        return address()

    def close(self) -> None:
        """Ends all that it started."""
        self._all.close()
