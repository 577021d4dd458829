"""A source that is played with a time line, and filled once by a node of its own."""
from __future__ import annotations

import asyncio
import sys
import tempfile
import threading
from pathlib import Path
from typing import Any

from angen_apps.web.feed import Feed
from angen_apps.web.timeline import Timeline
from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure
from angen_tools.live.sandbox import Sandbox, end

NUMBERS = ('flag', 'integer', 'number')  # types of fields that summaries have


class Played(Feed):
    """A Source, see server.py. A context: its end ends the node."""

    def __init__(self, length: float, name: str) -> None:
        super().__init__()
        self.store = Timeline()
        self._line: dict[str, Any] = {'end': length, 'loaded': 0.0, 'name': name}
        self.store.put('status', {'node': False, 'replay': True})
        self.store.put('line', dict(self._line))
        self._held = tempfile.TemporaryDirectory(prefix='angen_web_')
        self._folder = Path(self._held.name)
        self._sandbox = Sandbox(self._folder)
        self._node: Any = None
        self._now = 0.0

    def __enter__(self) -> Played:
        from angen_apps.web.node import start_node
        start_node('web')
        self._subscribe_usual()
        threading.Thread(target=self._work, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._sandbox.__exit__()
        self._held.cleanup()

    def _work(self) -> None:
        try:
            self._run()
        except Failure as failure:
            print(f'angen web: {failure}', file=sys.stderr, flush=True)

    def _run(self) -> None:
        """Fills the store."""
        raise NotImplementedError

    async def serve(self) -> None:
        """A thread of its own reads; nothing is to do for browsers."""
        await asyncio.Event().wait()

    def request(self, topics: set[str] | None) -> None:
        pass

    async def order(self, order: dict[str, Any]) -> dict[str, Any]:
        raise ValueError('a recording takes no orders')

    def _unsubscribe_all(self) -> None:
        for key in list(self._subscribers):
            self._drop(key)

    def _end_node(self) -> None:
        if self._node is not None:
            end(self._node)

    def _finish(self) -> None:
        self._line['loaded'] = self._line['end']
        self.store.put('line', dict(self._line))

    @staticmethod
    def _fields(kind: str) -> list[str]:
        """The names of the values of a kind's summaries."""
        return [field['name'] for field in kinds()[kind]['fields'] if field['type'] in NUMBERS]
