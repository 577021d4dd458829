"""A simulator of the home that is drawn, on a master of its own, and its page."""
from __future__ import annotations

import json
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path
from subprocess import Popen
from typing import Any

from angen_tools.common.failure import Failure
from angen_tools.common.port import free_port
from angen_tools.common.wait import wait
from angen_tools.live.sandbox import Sandbox, end

PROGRAM = 'from angen_tools.cli.main import main; main()'
LIMIT = 60.0  # s until the page is served


class Simulation:
    """Starts at the first run; later ones have another node with the same page."""

    def __init__(self, host: str) -> None:
        self._host = host
        self._all = ExitStack()
        self._sandbox: Sandbox | None = None
        self._node: Popen[bytes] | None = None
        self._address = ''

    def run(self, world: Path) -> str:
        """The address of the page of the world, which runs."""
        if self._sandbox is None:
            folder = self._all.enter_context(tempfile.TemporaryDirectory(prefix='angen_edit_'))
            self._sandbox = self._all.enter_context(Sandbox(Path(folder)))
        if self._node is not None:
            end(self._node)
        self._node = self._sandbox.node(world, 1.0)
        if not self._address:
            self._address = self._serve(self._sandbox)
        return self._address

    def _serve(self, sandbox: Sandbox) -> str:
        words = ['--host', self._host, '--port', str(free_port()), '--json']
        page = sandbox.start([sys.executable, '-c', PROGRAM, 'web', *words], 'web')
        log = sandbox.folder / 'web.log'

        def address() -> str:
            if page.poll() is not None:
                raise Failure(f'angen web ended: {log.read_text(errors="replace").strip()}')
            line: Any = next((line for line in log.read_text().splitlines()
                              if line.startswith('{') and line.endswith('}')), None)
            return str(json.loads(line)['address']) if line else ''

        wait(lambda: bool(address()), 'the page is not served', LIMIT)
        return address()

    def close(self) -> None:
        """Ends all that it started."""
        self._all.close()
