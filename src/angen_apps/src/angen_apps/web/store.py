"""The newest state of the building, of which each browser gets what changed since it got some last:
a slow browser gets fewer and larger changes, never a backlog.
"""
import itertools
import struct
import threading
from collections import deque
from dataclasses import dataclass, field
from typing import Any, Callable, Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from angen_apps.web.history import History

EVENTS = 500  # kept for a new browser
POSES, LEVELS, PICTURE, SCAN = 1, 2, 3, 4  # kinds of binary messages; see docs/web.md
HEAD = struct.Struct('<II')  # the kind, and the scene's number or the length of a name
Row = tuple[str, str, str, bool, float, list[float | None]]  # kind name text alarm stamp values


def summary(kind: str, name: str, text: str, alarm: bool, stamp: float, values: Sequence[float]
            ) -> Row:
    """A summary; JSON has no NaN."""
    return kind, name, text, alarm, stamp, [v if v - v == 0.0 else None for v in values]


@dataclass
class Update:
    """The next messages of a browser: parts of a JSON message, and binary messages."""

    version: int
    parts: dict[str, Any] = field(default_factory=dict)
    blobs: list[bytes] = field(default_factory=list)
    more: bool = False  # there is more already

    def __bool__(self) -> bool:
        return bool(self.parts or self.blobs)


class Slots:
    """Values of fixed size by index, with the version at which each changed."""

    def __init__(self, width: int) -> None:
        self._width = width
        self._values: NDArray[np.float32] = np.zeros((0, width), np.float32)
        self._versions: NDArray[np.int64] = np.zeros(0, np.int64)

    def put(self, indices: NDArray[np.uint32], values: NDArray[np.float32], version: int) -> None:
        """Sets some of them."""
        if not len(indices):
            return
        size = int(indices.max()) + 1
        if size > len(self._versions):
            more = size - len(self._versions)
            self._values = np.concatenate([self._values, np.zeros((more, self._width), np.float32)])
            self._versions = np.concatenate([self._versions, np.zeros(more, np.int64)])
        self._values[indices] = values.reshape(-1, self._width)
        self._versions[indices] = version

    def touch(self, version: int) -> None:
        """Makes all that were ever set count as changed."""
        self._versions[self._versions > 0] = version

    def since(self, version: int, kind: int, scene: int) -> list[bytes]:
        """The binary message of those that changed after a version, if any."""
        indices = np.flatnonzero(self._versions > version)
        if not len(indices):
            return []
        return [HEAD.pack(kind, scene) + struct.pack('<I', len(indices))
                + indices.astype('<u4').tobytes() + self._values[indices].astype('<f4').tobytes()]


class Store:
    """Filled by threads of ROS, or by a recording; read by the server."""

    def __init__(self, changed: Callable[[], None] = lambda: None) -> None:
        self.changed = changed  # called after each change
        self._lock = threading.Lock()
        self._versions = itertools.count(1)
        self._version = 0
        self._parts: dict[str, tuple[int, Any]] = {}
        self.history = History()
        self._rows: dict[tuple[str, str], tuple[int, Row]] = {}  # in the order of their changes
        self._whole = 0  # the version at which the rows were last replaced
        self._events: deque[tuple[int, Any]] = deque(maxlen=EVENTS)
        self._named: dict[str, tuple[int, bytes]] = {}  # pictures and scans
        self._scene: dict[str, Any] | None = None
        self._scene_number = 0
        self._revision = -1  # revision of the poses and levels
        self._poses = Slots(7)
        self._levels = Slots(1)

    def _next(self) -> int:
        self._version = next(self._versions)
        return self._version

    # --- written

    def put(self, part: str, value: Any) -> None:
        """A part of the JSON message, which replaces the one before."""
        with self._lock:
            if part in self._parts and self._parts[part][1] == value:
                return
            self._parts[part] = (self._next(), value)
        self.changed()

    def put_rows(self, rows: Iterable[Row], complete: bool) -> None:
        """Summaries of sensors and devices; `complete`: these are all."""
        with self._lock:
            version = self._next()
            if complete:
                self._rows, self._whole = {}, version
            for row in rows:
                self._rows.pop(row[:2], None)
                self._rows[row[:2]] = (version, row)
                if row[2]:
                    self.history.put(*row[:2], row[4], row[5])
        self.changed()

    def add_event(self, event: Any) -> None:
        """An entry of the event log."""
        with self._lock:
            self._events.append((self._next(), event))
        self.changed()

    def put_scene(self, scene: dict[str, Any], revision: int) -> None:
        """Another scene, or the same one again. Poses of its revision may have come before it."""
        with self._lock:
            if (self._scene, self._revision) == ({**scene, 'number': self._scene_number}, revision):
                return  # its topic was subscribed again
            version = self._next()
            self._scene_number += 1
            self._scene = {**scene, 'number': self._scene_number}
            if revision != self._revision:
                self._begin(revision)
            self._poses.touch(version)
            self._levels.touch(version)
            self._parts['scene'] = (version, self._scene_number)
        self.changed()

    def _begin(self, revision: int) -> None:
        self._revision = revision
        self._poses, self._levels = Slots(7), Slots(1)

    def put_changes(self, revision: int, links: NDArray[np.uint32], poses: NDArray[np.float32],
                    lights: NDArray[np.uint32], levels: NDArray[np.float32],
                    time: float = 0.0) -> None:
        """Poses of links and levels of lights at a time, of the scene of a revision."""
        with self._lock:
            if revision != self._revision:
                self._begin(revision)
            version = self._next()
            self._poses.put(links, poses, version)
            self._levels.put(lights, levels, version)
        self.changed()

    def put_named(self, kind: int, name: str, content: bytes) -> None:
        """A picture or a scan, for the browsers that show it."""
        label = name.encode()
        blob = HEAD.pack(kind, len(label)) + label + bytes(-len(label) % 4) + content
        with self._lock:
            self._named[name] = (self._next(), blob)
        self.changed()

    def clear(self) -> None:
        """Forgets readings and pictures; the scene stays, as it was."""
        with self._lock:
            self._rows, self._whole = {}, self._next()
        self.clear_named()

    def clear_named(self) -> None:
        """Forgets pictures and scans."""
        with self._lock:
            self._named.clear()

    # --- read

    @property
    def scene(self) -> dict[str, Any] | None:
        """The scene, with its number."""
        with self._lock:
            return self._scene

    def part(self, name: str) -> Any:
        """A part's value, or None."""
        with self._lock:
            return self._parts.get(name, (0, None))[1]

    def since(self, seen: int, named: Iterable[str] = (), hidden: Iterable[str] = ()) -> Update:
        """Changes after version `seen`: parts but the hidden ones, named pictures, scans."""
        with self._lock:
            update = Update(self._version)
            update.parts = {name: value for name, (version, value) in self._parts.items()
                            if version > seen and name not in hidden}
            rows = list(self._rows_since(seen))
            if rows or self._whole > seen:
                update.parts['rows'] = rows
                update.parts['complete'] = self._whole > seen
            events = [event for version, event in self._events if version > seen]
            if events:
                update.parts['events'] = events
            if self._scene is not None and self._revision == self._scene['revision']:
                update.blobs += self._poses.since(seen, POSES, self._scene_number)
                update.blobs += self._levels.since(seen, LEVELS, self._scene_number)
            for name in named:
                version, blob = self._named.get(name, (0, b''))
                if version > seen:
                    update.blobs.append(blob)
            return update

    def _rows_since(self, seen: int) -> Iterable[Row]:
        for version, row in reversed(self._rows.values()):
            if version <= seen:
                return
            yield row
