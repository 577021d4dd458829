"""A source that is played with a time line, and filled once by a node of its own."""
from __future__ import annotations

import asyncio
import sys
import tempfile
import threading
from pathlib import Path
from typing import Any, Self

from angen_apps.web.feed import Feed
from angen_apps.web.timeline import Timeline
from angen_tools.common.failure import Failure
from angen_tools.live.sandbox import Sandbox, end


class Lined(Feed):
    """A Source with a time line, see server.py: a thread fills it once, then it stays. A context:
    its end ends the subscriptions."""

    is_past = True  # whether it has ended already
    is_filmed = False

    def __init__(self, length: float, name: str) -> None:
        super().__init__()
        self.store = Timeline()
        self._line: dict[str, Any] = {'end': length, 'loaded': 0.0, 'name': name}
        self.store.put('status', {'node': False, 'replay': True})
        self.store.put('line', dict(self._line))
        self._failure: Failure | None = None
        self._filled = False

    def __enter__(self) -> Self:
        from angen_apps.web.node import start_node
        start_node('web')
        self._subscribe_usual()
        self._prepare()
        threading.Thread(target=self._work, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._unsubscribe_all()

    def _prepare(self) -> None:
        """Before the thread begins; Failure where it could not."""

    def is_whole(self) -> bool:
        """Whether all is read; Failure if it cannot be."""
        if self._failure is not None:
            raise self._failure
        return self._filled

    def share(self) -> float:
        """The part that is read."""
        begin, end = (self._line.get('begin', 0.0) if not self.is_past else 0.0), self._line['end']
        return (self._line['loaded'] - begin) / (end - begin) if end > begin else 0.0

    def _work(self) -> None:
        try:
            self._run()
        except Failure as failure:
            self._failure = failure
            if not self.is_filmed:  # else the film ends with it
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

    def _on_changes(self, message: Any) -> None:
        self.store.put_changes(message.revision, message.links, message.poses, message.lights,
                               message.levels, message.header.stamp.to_sec())

    def _unsubscribe_all(self) -> None:
        for key in list(self._subscribers):
            self._drop(key)

    def _finish(self) -> None:
        self._line['loaded'] = self._line['end']
        self.store.put('line', dict(self._line))
        self._filled = True


class Played(Lined):
    """One that a node of its own fills. A context: its end ends the node."""

    def __init__(self, length: float, name: str) -> None:
        super().__init__(length, name)
        self._held = tempfile.TemporaryDirectory(prefix='angen_web_')
        self._folder = Path(self._held.name)
        self._sandbox = Sandbox(self._folder)
        self._node: Any = None

    def __exit__(self, *_: object) -> None:
        self._sandbox.__exit__()
        self._held.cleanup()

    def _end_node(self) -> None:
        if self._node is not None:
            end(self._node)
