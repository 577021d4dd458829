"""A source that is played with a time line, and filled once."""
import asyncio
import dataclasses
import sys
import threading
from typing import Any, Self

from angen_apps.web import scene
from angen_apps.web.store import Store
from angen_apps.web.timeline import Timeline
from angen_tools.common.failure import Failure
from angen_tools.session.in_process import InProcess


class Lined:
    """A Source with a time line, see server.py: a thread fills it once, then it stays. A context:
    its end ends what fills it."""

    is_past = True  # whether it has ended already
    is_filmed = False

    def __init__(self, length: float, name: str) -> None:
        super().__init__()
        self.store: Store = Timeline()
        self._line: dict[str, Any] = {'end': length, 'loaded': 0.0, 'name': name}
        self.store.put('status', {'node': False, 'replay': True})
        self.store.put('line', dict(self._line))
        self._failure: Failure | None = None
        self._filled = False

    def __enter__(self) -> Self:
        self._prepare()
        threading.Thread(target=self._work, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        pass

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

    def close(self) -> None:
        pass

    def _show(self, world: Any, **home: Any) -> list[bool]:
        """What pages show of an angen.World, but what moves; `home`: more of the home. Returns
        which links move."""
        inside, drawn = InProcess(world), world.scene
        self.store.put('home', {**dataclasses.asdict(inside.home), **home})
        self.store.put('entities', [*map(scene.of_entity, inside.entities())])
        self.store.put_scene(scene.packed(drawn), drawn['revision'])
        return [link['moves'] for link in drawn['links']]

    def _finish(self) -> None:
        self._line['loaded'] = self._line['end']
        self.store.put('line', dict(self._line))
        self._filled = True
