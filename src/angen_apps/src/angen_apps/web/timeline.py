"""A recorded run as a page plays it: all that changed, with its time; the page keeps it."""
import bisect
from typing import Any, Iterable

import numpy as np
from numpy.typing import NDArray

from angen_apps.web.store import Row, Store, Update

CHUNK = 3000  # entries of a message
PARTS = ('status', 'scene', 'home', 'entities', 'line', 'symbols')  # sent without time


class Timeline(Store):
    """A store that forgets nothing. Links and lights are known by name: models come and go."""

    def __init__(self) -> None:
        super().__init__()
        self._entries: list[Any] = []
        self._entry_versions: list[int] = []
        self._ids: dict[str, int] = {}
        self._known: dict[int, tuple[list[int], list[int]]] = {}  # ids by revision
        self._waiting: list[tuple[Any, ...]] = []  # changes of a scene that has not come yet
        self._texts: dict[tuple[str, str], tuple[Any, ...]] = {}

    def _id(self, name: str) -> int:
        return self._ids.setdefault(name, len(self._ids))

    def _log(self, entry: Any) -> None:
        self._entries.append(entry)
        self._entry_versions.append(self._next())

    def put_scene(self, scene: dict[str, Any], revision: int) -> None:
        links = [f'{link["model"]}::{link["name"]}' for link in scene['links']]
        lights = [f'light {light["name"]}' for light in scene['lights']]
        with self._lock:
            self._known[revision] = ([self._id(name) for name in links],
                                     [self._id(name) for name in lights])
            named = {**scene, 'ids': self._known[revision][0],
                     'light_ids': self._known[revision][1]}
        super().put_scene(named, revision)
        waiting, self._waiting = self._waiting, []
        for changes in waiting:
            self.put_changes(*changes)

    def put_changes(self, revision: int, links: NDArray[np.uint32], poses: NDArray[np.float32],
                    lights: NDArray[np.uint32], levels: NDArray[np.float32],
                    time: float = 0.0) -> None:
        with self._lock:
            if revision not in self._known:
                self._waiting.append((revision, links.copy(), poses.copy(), lights.copy(),
                                      levels.copy(), time))
                return
            link_ids, light_ids = self._known[revision]
            if len(links):
                self._log(['p', time, [link_ids[link] for link in links],
                           np.round(poses.astype(float), 4).tolist()])
            if len(lights):
                self._log(['l', time, [light_ids[light] for light in lights],
                           np.round(levels.astype(float), 4).tolist()])
        self.changed()

    def put_rows(self, rows: Iterable[Row], complete: bool) -> None:
        with self._lock:
            for row in rows:
                shown = (row[2], row[3], *row[5])
                if self._texts.get(row[:2]) != shown:
                    self._texts[row[:2]] = shown
                    self._log(['r', row[4], *row])
                if row[2]:
                    self.history.put(*row[:2], row[4], row[5])
        self.changed()

    def add_event(self, event: Any) -> None:
        with self._lock:
            self._log(['e', event[0], event])
        self.changed()

    def since(self, seen: int, named: Iterable[str] = (), hidden: Iterable[str] = ()) -> Update:
        with self._lock:
            update = Update(self._version)
            first = bisect.bisect_right(self._entry_versions, seen)
            entries = self._entries[first:first + CHUNK]
            if first + CHUNK < len(self._entries):  # the rest comes next
                update.version = self._entry_versions[first + CHUNK - 1]
            update.parts = {name: value for name, (version, value) in self._parts.items()
                            if seen < version <= update.version and name in PARTS}
            if entries:
                update.parts['timeline'] = entries
            update.more = first + CHUNK < len(self._entries)
            return update
