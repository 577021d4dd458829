"""A while of the running building as a source with a time line: it is read as it happens."""
import time

from angen_apps.web.feed import Feed
from angen_apps.web.node import start_node
from angen_apps.web.played import Lined
from angen_tools.common.failure import Failure
from angen_tools.common.wait import wait

STARTS = 10.0  # s of wall time in which the building answers
TURN = 0.05


class Captured(Lined, Feed):
    """A Source, see server.py."""

    is_past = False

    def __init__(self, length: float) -> None:
        """`length`: simulated s."""
        super().__init__(length, 'live')
        self._length = length

    def __exit__(self, *_: object) -> None:
        self._unsubscribe_all()

    def _unsubscribe_all(self) -> None:
        for key in list(self._subscribers):
            self._drop(key)

    def _prepare(self) -> None:
        start_node('web')
        self._subscribe_usual()
        wait(lambda: self._subscribers['scene'].get_num_connections() > 0 and self._now > 0.0
             and bool(self.store.scene), 'no simulator runs, ./angen run starts one: none answered',
             STARTS)
        if (self.store.part('stats') or {}).get('paused'):
            raise Failure('the building is paused; angen resume continues it')
        self._survey()
        self._line.update(begin=self._now, end=self._now + self._length, loaded=self._now,
                          speed=1.0)

    def _run(self) -> None:
        while self._now < self._line['end']:
            time.sleep(TURN)
            self._line['loaded'] = min(self._now, self._line['end'])
        self._unsubscribe_all()
        self._finish()
