"""Keeps the world that the node saves when it loses the ROS master, for the next node."""
from __future__ import annotations

import os
import sys
import time
from collections import deque
from pathlib import Path

from angen_tools.common.failure import Failure

MOST, SPAN = 3, 60.0  # restarts within a time, s


def own_folder() -> Path:
    """A folder that only this user can use: $XDG_STATE_HOME/angen, or ~/.local/state/angen."""
    given = Path(os.environ.get('XDG_STATE_HOME', ''))
    folder = (given if given.is_absolute() else Path.home() / '.local' / 'state') / 'angen'
    try:
        folder.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        found = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        try:
            own = os.fstat(found).st_uid == os.getuid()
            if own:
                os.fchmod(found, 0o700)
        finally:
            os.close(found)
    except NotADirectoryError:  # a link, too
        own = False
    except OSError as error:
        raise Failure(f'{folder}: cannot be made: {error.strerror}') from None
    if not own:
        raise Failure(f'{folder}: is not a folder of yours; remove it')
    return folder


class Rescue:
    """The file of one ./angen run. A context: its end removes it, but not after a Failure."""

    def __init__(self) -> None:
        folder = own_folder()
        self.path = folder / f'rescue-{os.getpid()}.world'  # the node writes it
        self._world = folder / f'rescued-{os.getpid()}.world'  # the next node reads it
        self._times: deque[float] = deque(maxlen=MOST)

    def __enter__(self) -> Rescue:
        self.path.unlink(missing_ok=True)
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """After a Failure the world stays, and its path is printed."""
        for path in (self.path, self._world):
            if kind is not None and issubclass(kind, Failure) and path.exists():
                print(f'angen: the world is saved in {path}', file=sys.stderr, flush=True)
            else:
                path.unlink(missing_ok=True)

    def take(self) -> Path | None:
        """The world that the node has saved, for the next one; None if it saved none. Failure
        where that happens too often."""
        if not self.path.exists():
            return None
        now = time.monotonic()
        if len(self._times) == MOST and now - self._times[0] < SPAN:
            self._world.unlink()  # an older one
            raise Failure(f'the ROS master was lost {MOST + 1} times within {SPAN:g} s')
        self._times.append(now)
        return self.path.replace(self._world)
